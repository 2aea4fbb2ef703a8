// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <fmt/core.h>
#include <string>
#include <string_view>
#include <vector>

#include "study/faults.h"
#include "study/fit_file.h"
#include "study/suggest.h"

/// What the sections of a fit file are read with.
namespace millstudy::study {

inline constexpr std::array<std::string_view, 6> kCoefficientKeys = {
    "Ktc_N_per_mm2", "Krc_N_per_mm2", "Kac_N_per_mm2",
    "Kte_N_per_mm",  "Kre_N_per_mm",  "Kae_N_per_mm"};
inline constexpr std::array<std::string_view, 3> kAxisNames = {"x", "y", "z"};

/// A fit file on its way from the tree. Every step collects its faults.
struct FitReader {
  const core::Value& root;
  const FileLoader& load;
  Faults faults;
  FitFile file;

  core::Place whole() const { return {root.place.file, 0}; }
  void miss(std::string_view path) { faults.add(whole(), missing(*fit_keys().find_key(path))); }
  /// A section of the root; null if it is not there, or no table, which is a fault.
  const core::Value* section(std::string_view name);

  /// Visits the members of a table that are keys; says which are not. Tables among the sections of
  /// the root are left alone.
  template <class Visit>
  void for_each_key(const core::Value& table, std::string_view section, const Visit& visit) {
    std::vector<std::string_view> names;
    for (const std::span<const Key> keys : fit_keys().sections) {
      for (const Key& key : keys) {
        const bool inside = section.empty() ? key.path.find('.') == std::string_view::npos
                                            : key.path.starts_with(section) &&
                                                  key.path.substr(section.size()).starts_with('.');
        if (inside) names.push_back(key.path.substr(section.empty() ? 0 : section.size() + 1));
      }
    }
    for (const core::Member& member : table.table()) {
      const std::string path =
          section.empty() ? member.key : fmt::format("{}.{}", section, member.key);
      if (const Key* key = fit_keys().find_key(path)) {
        faults.collect([&] { visit(*key, member.value); });
      } else if (!section.empty()) {
        faults.add(member.value.place, fmt::format("{} is not a key of a fit file{}", path,
                                                   suggestion(member.key, names)));
      }
    }
  }
};

// Each throws core::InputError for a value of another form.
const core::Value& as_table(const Key& key, const core::Value& value);
/// A list of the key's choices.
std::vector<std::string> words(const Key& key, const core::Value& value);
double finite_number(const core::Value& value, const std::string& what);

/// [fit] into the settings. @return where fit.estimate stands
core::Place read_fit_section(FitReader& read);
/// [trace] and the [[record]]s, each with its cut; after read_fit_section().
void read_fit_records(FitReader& read);

}  // namespace millstudy::study
