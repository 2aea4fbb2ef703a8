// SPDX-License-Identifier: MIT
#include "study/file_axes.h"

#include <algorithm>
#include <fmt/core.h>
#include <set>

namespace millstudy::study {
namespace {

bool is_axis(const Key& key, const Study& study) {
  return std::any_of(study.axes.begin(), study.axes.end(),
                     [&](const Axis& axis) { return axis.key == &key; });
}

/// True if a file with these settings has to give the key.
bool is_needed_beside(const Key& key, const std::vector<Assignment>& settings) {
  const auto* only = std::get_if<RequiredFor>(&key.fallback);
  return key.required() ||
         (only && std::any_of(settings.begin(), settings.end(), [&](const Assignment& other) {
            return other.key->path == only->key && to_string(other.setting) == only->choice;
          }));
}

/// Completes what one file of an axis sets by the default of a key that others give.
void settle(const Key& key, std::size_t file, Axis& axis, Given& given, Faults& faults) {
  Given::Entry& entry = given.entries.at(key.path);
  std::vector<Assignment>& settings = axis.settings[file];
  auto at = std::find_if(settings.begin(), settings.end(),
                         [&](const Assignment& assignment) { return assignment.key == &key; });
  if (at == settings.end()) {
    if (is_needed_beside(key, settings)) {
      faults.add(entry.place, fmt::format("sweep.axes: {} = \"{}\" does not give {}, as others do",
                                          axis.key->path, axis.labels[file], key.path));
    }
    at = settings.insert(at, {&key, default_setting(key)});
  }
  const auto* choice = std::get_if<std::string>(&at->setting);
  if (key.type == KeyType::choice && choice) entry.choices.push_back(*choice);
}

}  // namespace

void check_not_idle(const Key& file, const std::vector<Assignment>& settings, const IsOwn& is_own,
                    const core::Place& place) {
  const bool sets =
      std::any_of(settings.begin(), settings.end(), [&](const Assignment& assignment) {
        return assignment.key == &file || !is_own(*assignment.key);
      });
  if (sets) return;
  throw core::InputError(place, fmt::format("{} changes nothing: the study itself gives every key "
                                            "of the file; leave one of them out",
                                            file.path));
}

void settle_file_axes(Study& study, Given& given, const IsOwn& is_own, Faults& faults) {
  for (Axis& axis : study.axes) {
    if (axis.key->type != KeyType::file || axis.key->field) continue;
    const core::Place place = given.entries.at(axis.key->path).place;
    std::set<const Key*> all;
    for (std::vector<Assignment>& settings : axis.settings) {
      const bool fine = faults.collect([&] { check_not_idle(*axis.key, settings, is_own, place); });
      if (!fine) return;
      std::erase_if(settings, [&](const Assignment& assignment) {
        return is_own(*assignment.key) || is_axis(*assignment.key, study);
      });
      for (const Assignment& assignment : settings) all.insert(assignment.key);
    }
    for (const Key* key : all) {
      given.entries[key->path] = {key, place, true, {}};
      for (std::size_t i = 0; i < axis.settings.size(); ++i) settle(*key, i, axis, given, faults);
    }
  }
}

}  // namespace millstudy::study
