// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "study/study.h"

namespace millstudy::study::testing {

using core::Value;

/// A tree written as literals; every value stands on line 1 of "test.toml".
inline Value table(std::initializer_list<std::pair<std::string, Value>> members) {
  Value::Table table;
  for (const auto& [key, value] : members) table.push_back({key, value});
  return {std::move(table), {"test.toml", 1}};
}
inline Value of(double number) {
  return {number, {"test.toml", 1}};
}
inline Value of(int number) {
  return {std::int64_t{number}, {"test.toml", 1}};
}
inline Value of(const char* text) {
  return {std::string(text), {"test.toml", 1}};
}
inline Value of(bool flag) {
  return {flag, {"test.toml", 1}};
}
inline Value of(Value value) {
  return value;
}
template <class... Items>
Value list(Items... items) {
  return {Value::Array{of(items)...}, {"test.toml", 1}};
}

/// A complete study of kind force; give it a sweep, or take things away.
inline Value slot_study() {
  return table({
      {"schema_version", of(1)},
      {"study", table({{"name", of("slot")}, {"kind", of("force")}})},
      {"cutter", table({{"shape", of("flat")},
                        {"diameter_mm", of(12.0)},
                        {"flutes", of(2)},
                        {"helix_deg", of(30.0)}})},
      {"coefficients", table({{"Ktc_N_per_mm2", of(2172.0)},
                              {"Krc_N_per_mm2", of(850.0)},
                              {"Kac_N_per_mm2", of(726.0)},
                              {"Kte_N_per_mm", of(17.3)},
                              {"Kre_N_per_mm", of(7.8)},
                              {"Kae_N_per_mm", of(6.7)}})},
      {"cut", table({{"axial_depth_mm", of(0.5)},
                     {"milling", of("slot")},
                     {"spindle_speed_rpm", of(14500.0)},
                     {"feed_rate_mm_per_min", of(1740.0)}})},
  });
}

/// Files by name, for studies that name some.
using Files = std::map<std::string, Value>;

inline Study resolved(const Value& root, const Files& files = {}) {
  return resolve(root, [&](const std::string& path) {
    if (!files.contains(path)) throw core::InputError(path + ": no such file");
    return files.at(path);
  });
}

/// The faults of a study, one line each; empty if it has none.
inline std::string faults_of(const Value& root, const Files& files = {}) {
  try {
    resolved(root, files);
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

inline Value& section(Value& root, const std::string& name) {
  return *root.find(name);
}
inline void set(Value& root, const std::string& name, const std::string& key, Value value) {
  Value::Table& members = section(root, name).table();
  for (core::Member& member : members) {
    if (member.key == key) {
      member.value = std::move(value);
      return;
    }
  }
  members.push_back({key, std::move(value)});
}
inline void remove(Value& root, const std::string& name, const std::string& key) {
  std::erase_if(section(root, name).table(),
                [&](const core::Member& member) { return member.key == key; });
}
inline void sweep(Value& root, std::initializer_list<std::pair<std::string, Value>> axes,
                  const char* design = "grid") {
  root.table().push_back({"sweep", table({{"design", of(design)}, {"axes", table(axes)}})});
}

}  // namespace millstudy::study::testing
