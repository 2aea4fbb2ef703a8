// SPDX-License-Identifier: MIT
#include "study/kind.h"

#include <algorithm>

namespace millstudy::study {

bool Given::swept(std::string_view path) const {
  const auto at = entries.find(path);
  return at != entries.end() && at->second.swept;
}

bool Given::may_be(std::string_view path, std::string_view choice) const {
  const auto at = entries.find(path);
  if (at == entries.end()) return false;
  const std::vector<std::string>& choices = at->second.choices;
  return std::find(choices.begin(), choices.end(), choice) != choices.end();
}

bool Given::any_swept(std::initializer_list<std::string_view> paths) const {
  return std::any_of(paths.begin(), paths.end(), [&](auto path) { return swept(path); });
}

bool Given::section_swept(std::string_view section) const {
  return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
    return entry.second.swept && entry.first.substr(0, entry.first.find('.')) == section;
  });
}

core::Place Given::place(std::initializer_list<std::string_view> paths) const {
  for (const std::string_view path : paths) {
    const auto at = entries.find(path);
    if (at != entries.end()) return at->second.place;
  }
  return file;
}

const Key* Kind::find_key(std::string_view path) const {
  for (const std::span<const Key> section : sections) {
    for (const Key& key : section) {
      if (key.path == path) return &key;
    }
  }
  return nullptr;
}

bool Kind::has_section(std::string_view path) const {
  const std::vector<std::string_view> paths = key_paths(*this);
  return std::any_of(paths.begin(), paths.end(), [&](std::string_view key) {
    return key.size() > path.size() && key.starts_with(path) && key[path.size()] == '.';
  });
}

void check_force_keys(const Given& given, const Case& base, Faults& faults) {
  check_cutter_keys(given, faults);
  check_coefficient_keys(given, faults);
  check_cut_keys(given, base, faults);
}

void check_force(const Given& given, const Case& base, Faults& faults) {
  check_cutter(given, base, faults);
  check_coefficients(given, base, faults);
  check_cut(given, base, faults);
  check_numerics(given, base, faults);
}

std::vector<std::string_view> key_paths(const Kind& kind) {
  std::vector<std::string_view> paths;
  for (const std::span<const Key> section : kind.sections) {
    for (const Key& key : section) paths.push_back(key.path);
  }
  return paths;
}

}  // namespace millstudy::study
