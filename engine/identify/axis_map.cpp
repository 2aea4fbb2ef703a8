// SPDX-License-Identifier: MIT
#include "identify/axis_map.h"

#include <fmt/core.h>

#include "identify/trace.h"

namespace millstudy::identify {
namespace {

std::string without_blanks(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

AxisSource parse_source(const std::string& text) {
  AxisSource source{without_blanks(text)};
  if (source.channel.empty()) return source;
  const char first = source.channel.front();
  if (first != '-' && first != '+') return source;
  return {without_blanks(source.channel.substr(1)), first == '-' ? -1.0 : 1.0};
}

}  // namespace

std::string AxisMap::to_string() const {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    if (!has_axis(axis)) continue;
    text += fmt::format("{}{} = {}{}", text.empty() ? "" : ", ", kAxisNames[axis],
                        axes[axis].sign < 0.0 ? "-" : "", axes[axis].channel);
  }
  return text;
}

AxisMap parse_axis_map(const std::array<std::string, 3>& texts, const core::Place& place) {
  AxisMap map;
  std::vector<core::Fault> faults;
  for (int axis = 0; axis < 3; ++axis) {
    map.axes[axis] = parse_source(texts[axis]);
    if (!map.has_axis(axis) && !without_blanks(texts[axis]).empty()) {
      faults.push_back({place, fmt::format("axes.{} = \"{}\" names no channel: write \"-Fy\" or "
                                           "\"Fy\"",
                                           kAxisNames[axis], texts[axis])});
    }
    for (int other = 0; other < axis; ++other) {
      if (!map.has_axis(axis) || map.axes[other].channel != map.axes[axis].channel) continue;
      faults.push_back(
          {place, fmt::format("axes.{} and axes.{} both take channel {}", kAxisNames[other],
                              kAxisNames[axis], map.axes[axis].channel)});
    }
  }
  if (faults.empty() && !map.has_axis(0) && !map.has_axis(1) && !map.has_axis(2)) {
    faults.push_back({place,
                      "axes name no channel: write axes = { x = \"-Fx\", y = \"-Fy\", "
                      "z = \"-Fz\" }"});
  }
  if (!faults.empty()) throw core::InputError(std::move(faults));
  return map;
}

}  // namespace millstudy::identify
