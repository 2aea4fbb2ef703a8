// SPDX-License-Identifier: MIT
#include "study/outputs.h"

#include <algorithm>

#include "core/error.h"
#include "study/rows.h"

namespace millstudy::study {
namespace {

bool flag(std::string_view path, const SettingMap& settings) {
  const auto setting = settings.find(path);
  return setting != settings.end() && std::get<bool>(setting->second);
}

int most_flutes(const Study& study, const SettingMap& settings, const Given& given) {
  int most = 0;
  const Key* key = study.kind->find_key("cutter.flutes");
  for (const Setting& setting : all_settings(*key, study, settings, given)) {
    most = std::max(most, static_cast<int>(std::get<double>(setting)));
  }
  return most;
}

}  // namespace

std::vector<Setting> all_settings(const Key& key, const Study& study, const SettingMap& settings,
                                  const Given& given) {
  std::vector<Setting> all;
  const auto own = settings.find(key.path);
  if (own != settings.end() && !given.swept(key.path)) all.push_back(own->second);
  for (const Axis& axis : study.axes) {
    if (axis.key == &key) all.insert(all.end(), axis.numbers.begin(), axis.numbers.end());
    for (const std::vector<Assignment>& assignments : axis.settings) {
      for (const Assignment& assignment : assignments) {
        if (assignment.key == &key) all.push_back(assignment.setting);
      }
    }
  }
  return all;
}

Outputs asked_outputs(const Study& study, const SettingMap& settings, const Given& given) {
  Outputs outputs;
  outputs.traces = flag("output.traces", settings);
  const auto harmonics = settings.find("output.harmonics");
  if (harmonics != settings.end()) {
    outputs.harmonics = static_cast<int>(std::get<double>(harmonics->second));
  }
  if (flag("output.per_flute", settings)) outputs.flutes = most_flutes(study, settings, given);
  outputs.depth_is_axis = given.swept("cut.axial_depth_mm");
  outputs.bending_moment = given.has("cutter.stick_out_mm");
  return outputs;
}

void check_outputs(const Study& study, const Given& given, Faults& faults) {
  if (study.outputs.harmonics == 0) return;  // kind path has none
  if (given.any_swept({"cutter.flutes", "numerics.angular_steps"})) return;
  try {
    figure_request(study.base, study.outputs);
  } catch (const core::CaseError& error) {
    faults.add(given.place({"output.harmonics"}), error.what());
  }
}

}  // namespace millstudy::study
