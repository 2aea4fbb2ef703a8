// SPDX-License-Identifier: MIT
#include "study/fit_reader.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace millstudy::study {

const core::Value* FitReader::section(std::string_view name) {
  const core::Value* found = root.find(name);
  if (found && !found->is_table()) {
    faults.add(found->place, fmt::format("{} must be a table, not {}", name, type_name(*found)));
    return nullptr;
  }
  return found;
}

const core::Value& as_table(const Key& key, const core::Value& value) {
  if (!value.is_table()) {
    throw core::InputError(value.place,
                           fmt::format("{} must be a table, not {}", key.path, type_name(value)));
  }
  return value;
}

std::vector<std::string> words(const Key& key, const core::Value& value) {
  if (!value.is_array()) {
    throw core::InputError(value.place,
                           fmt::format("{} must be a list of {}, not {}", key.path,
                                       fmt::join(key.choices, ", "), type_name(value)));
  }
  std::vector<std::string> out;
  for (const core::Value& item : value.array()) {
    if (!item.is_string() ||
        std::find(key.choices.begin(), key.choices.end(), item.string()) == key.choices.end()) {
      throw core::InputError(item.place,
                             fmt::format("{} holds {}; it is a list of {}", key.path,
                                         item.is_string() ? fmt::format("\"{}\"", item.string())
                                                          : std::string(type_name(item)),
                                         fmt::join(key.choices, ", ")));
    }
    out.push_back(item.string());
  }
  return out;
}

double finite_number(const core::Value& value, const std::string& what) {
  if (!value.is_number() || !std::isfinite(value.number())) {
    throw core::InputError(value.place, fmt::format("{} must be a number", what));
  }
  return value.number();
}

}  // namespace millstudy::study
