// SPDX-License-Identifier: MIT
#include "io/response_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "io/trace_file.h"

namespace millstudy::io {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Names of frequency, real and imaginary part in that order.
std::array<std::string, 3> columns(const std::string& path) {
  const std::vector<std::string> names = trace_variables(path);
  const auto find = [&](std::initializer_list<std::string_view> words) {
    for (const std::string& name : names) {
      for (const std::string_view word : words) {
        if (lower(name).find(word) != std::string::npos) return name;
      }
    }
    return std::string();
  };
  const std::array<std::string, 3> found = {find({"freq"}), find({"real"}), find({"imag"})};
  const bool all = std::none_of(found.begin(), found.end(),
                                [](const std::string& name) { return name.empty(); });
  if (all) return found;
  if (!find({"mag", "ampl", "phase"}).empty()) {
    throw core::InputError({path, 0},
                           fmt::format("has amplitudes or phases ({}): a frequency response must "
                                       "be given by its real and imaginary part",
                                       fmt::join(names, ", ")));
  }
  if (names.size() == 3) return {names[0], names[1], names[2]};
  throw core::InputError(
      {path, 0}, fmt::format("has no columns named frequency, real and imaginary: {}",
                             names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

double hertz_per_unit(const identify::Channel& frequency, const std::string& path) {
  const std::string& unit = frequency.unit;
  if (unit.empty() || lower(unit) == "hz") return 1.0;
  if (lower(unit) == "khz") return 1e3;
  if (lower(unit) == "rad/s") return 0.5 / std::numbers::pi;
  throw core::InputError({path, 0},
                         fmt::format("the frequency is in \"{}\", not in Hz, kHz or rad/s", unit));
}

}  // namespace

bool is_response_file(const std::string& path) {
  constexpr std::array<std::string_view, 10> kEndings = {".frf", ".csv",  ".tsv", ".txt", ".dat",
                                                         ".h5",  ".hdf5", ".mat", ".lvm", ".tdms"};
  const std::string ending = lower(std::filesystem::path(path).extension().string());
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

core::Value read_response_file(const std::string& path) {
  const std::array<std::string, 3> names = columns(path);
  TraceSelection selection;
  constexpr std::array<const char*, 3> kOwn = {"frequency", "real", "imaginary"};
  for (std::size_t i = 0; i < 3; ++i) selection.variables[kOwn[i]] = names[i];
  const identify::ChannelSet set = read_trace_file(path, selection).channels;
  std::array<const identify::Channel*, 3> channel;
  for (std::size_t i = 0; i < 3; ++i) {
    channel[i] = set.find(kOwn[i]);
    if (!channel[i] || channel[i]->samples.size() != channel[0]->samples.size()) {
      throw core::InputError(
          {path, 0}, fmt::format("\"{}\" and \"{}\" are not equally long", names[0], names[i]));
    }
  }
  if (channel[1]->unit != channel[2]->unit) {
    throw core::InputError({path, 0},
                           fmt::format("the real part is in \"{}\", the imaginary in \"{}\"",
                                       channel[1]->unit, channel[2]->unit));
  }
  const double hertz = hertz_per_unit(*channel[0], path);
  const core::Place file = {path, 0};
  core::Value::Array points;
  points.reserve(channel[0]->samples.size());
  for (std::size_t i = 0; i < channel[0]->samples.size(); ++i) {
    const core::Place place = {path, set.line_of(i)};
    points.push_back({core::Value::Array{{hertz * channel[0]->samples[i], place},
                                         {channel[1]->samples[i], place},
                                         {channel[2]->samples[i], place}},
                      place});
  }
  const std::string unit = channel[1]->unit.empty() ? "m/N" : channel[1]->unit;
  return {core::Value::Table{{"points", {std::move(points), file}}, {"unit", {unit, file}}}, file};
}

}  // namespace millstudy::io
