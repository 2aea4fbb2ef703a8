// SPDX-License-Identifier: MIT
#include "core/error.h"

#include <cstddef>

namespace millstudy::core {
namespace {

constexpr std::size_t kLongestLine = 400;

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += to_string(fault);
  }
  return text;
}

/// Printable: what a file contains must not move the cursor of whoever reads the message.
std::string printable(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (line.size() >= kLongestLine) return line + "...";
    const auto byte = static_cast<unsigned char>(c);
    line += (byte < 0x20 || byte == 0x7f) ? '?' : c;
  }
  return line;
}

}  // namespace

std::string to_string(const Place& place) {
  if (place.file.empty() || place.line <= 0) return place.file;
  return place.file + ':' + std::to_string(place.line);
}

std::string to_string(const Fault& fault) {
  const std::string place = to_string(fault.place);
  return printable(place.empty() ? fault.text : place + ": " + fault.text);
}

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(joined(faults)), faults_(std::move(faults)) {}

InputError::InputError(Place place, std::string text)
    : InputError(std::vector<Fault>{Fault{std::move(place), std::move(text)}}) {}

}  // namespace millstudy::core
