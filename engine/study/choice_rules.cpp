// SPDX-License-Identifier: MIT
#include "study/choice_rules.h"

#include <algorithm>
#include <fmt/format.h>

namespace millstudy::study {
namespace {

/// What a choice is over the study; empty where its value is missing or at fault.
std::vector<std::string> values_of(std::string_view path, const Kind& kind, const Given& given) {
  const auto entry = given.entries.find(path);
  if (entry != given.entries.end()) return entry->second.choices;
  const auto* fallback = std::get_if<std::string_view>(&kind.find_key(path)->fallback);
  if (fallback) return {std::string(*fallback)};
  return {};
}

bool contains(const std::vector<std::string>& values, std::string_view value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

}  // namespace

bool is_needed(const Key& key, const Kind& kind, const Given& given) {
  const auto* only = std::get_if<RequiredFor>(&key.fallback);
  return key.required() || (only && contains(values_of(only->key, kind, given), only->choice));
}

void check_uses(const Kind& kind, const Given& given, Faults& faults) {
  for (const auto& [path, entry] : given.entries) {
    const OnlyFor& only = entry.key->only_for;
    if (only.key.empty()) continue;
    const std::vector<std::string> values = values_of(only.key, kind, given);
    const bool of_use = std::any_of(only.choices.begin(), only.choices.end(),
                                    [&](std::string_view use) { return contains(values, use); });
    if (values.empty() || of_use) continue;
    faults.add(entry.place, fmt::format("{} is not used by {} {}: leave it out", path,
                                        kind.find_key(only.key)->name(), fmt::join(values, ", ")));
  }
}

}  // namespace millstudy::study
