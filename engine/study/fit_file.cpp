// SPDX-License-Identifier: MIT
#include "study/fit_file.h"

#include <algorithm>

#include "core/units.h"
#include "study/fit_reader.h"

namespace millstudy::study {
namespace {

void check_sections(FitReader& read) {
  static constexpr std::array<std::string_view, 9> known = {
      "schema_version", "fit",         "trace", "record", "dynamometer",
      "cutter",         "cutter_file", "cut",   "study"};
  for (const core::Member& member : read.root.table()) {
    if (member.key == "study") {
      read.faults.add(member.value.place,
                      "this is a study: millstudy run computes it; a fit file has [fit]");
    } else if (std::find(known.begin(), known.end(), member.key) == known.end()) {
      read.faults.add(member.value.place, fmt::format("{} is not a section of a fit file{}",
                                                      member.key, suggestion(member.key, known)));
    }
  }
}

// --- [[dynamometer.x]]

void read_mode(FitReader& read, const core::Value& item, int axis) {
  if (!item.is_table()) {
    return read.faults.add(item.place,
                           fmt::format("a mode must be a table, not {}", type_name(item)));
  }
  dynamics::DynamometerMode mode;
  mode.gain = 1.0;
  const std::string name_of_section = fmt::format("dynamometer.{}", kAxisNames[axis]);
  read.for_each_key(item, name_of_section, [&](const Key& key, const core::Value& value) {
    const double x = std::get<double>(checked_setting(key, value));
    if (key.name() == "frequency_Hz") mode.mode.natural_frequency = core::kTurn * x;
    if (key.name() == "damping_ratio") mode.mode.damping_ratio = x;
    if (key.name() == "gain") mode.gain = x;
  });
  for (const char* name : {"frequency_Hz", "damping_ratio"}) {
    if (!item.find(name)) {
      read.faults.add(item.place,
                      fmt::format("dynamometer.{}.{} is missing", kAxisNames[axis], name));
    }
  }
  read.file.settings.dynamometer[axis].push_back(mode);
}

void read_modes(FitReader& read, const core::Place& estimate) {
  const core::Value* dynamometer = read.section("dynamometer");
  bool any = false;
  if (dynamometer) {
    for (const core::Member& member : dynamometer->table()) {
      const auto axis =
          std::find(kAxisNames.begin(), kAxisNames.end(), member.key) - kAxisNames.begin();
      if (axis == 3 || !member.value.is_array()) {
        read.faults.add(member.value.place,
                        "dynamometer has lists of modes: [[dynamometer.x]], y and z");
        continue;
      }
      for (const core::Value& item : member.value.array()) {
        read_mode(read, item, static_cast<int>(axis));
        any = true;
      }
    }
  }
  if (read.file.settings.estimate_dynamometer && !any) {
    read.faults.add(estimate,
                    "fit.estimate holds dynamometer, which needs modes to begin with: "
                    "[[dynamometer.x]] with frequency_Hz, damping_ratio and gain");
  }
}

}  // namespace

FitFile read_fit_file(const core::Value& root, const FileLoader& load) {
  if (!root.is_table()) throw core::InputError(root.place, "a fit file must be a table");
  FitReader read{root, load, {}, {}};
  check_sections(read);
  read.for_each_key(root, "", [&](const Key& key, const core::Value& value) {
    if (key.path == "schema_version") checked_setting(key, value);
  });
  if (!root.find("schema_version")) read.miss("schema_version");
  const core::Place estimate = read_fit_section(read);
  read_modes(read, estimate);
  read_fit_records(read);
  read.faults.throw_if_any();
  return std::move(read.file);
}

}  // namespace millstudy::study
