// SPDX-License-Identifier: MIT
#include "study/kind.h"

#include <algorithm>

namespace millstudy::study {

bool Given::swept(std::string_view path) const {
  const auto at = entries.find(path);
  return at != entries.end() && at->second.swept;
}

bool Given::any_swept(std::initializer_list<std::string_view> paths) const {
  return std::any_of(paths.begin(), paths.end(), [&](auto path) { return swept(path); });
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

std::vector<std::string_view> key_paths(const Kind& kind) {
  std::vector<std::string_view> paths;
  for (const std::span<const Key> section : kind.sections) {
    for (const Key& key : section) paths.push_back(key.path);
  }
  return paths;
}

}  // namespace millstudy::study
