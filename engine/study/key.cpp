// SPDX-License-Identifier: MIT
#include "study/key.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <fmt/core.h>

#include "core/units.h"

namespace millstudy::study {

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::broken_by(double value) const {
  const bool too_low = low_open ? value <= low : value < low;
  if (too_low) return fmt::format("{} {}", low_open ? ">" : ">=", low);
  return fmt::format("{} {}", high_open ? "<" : "<=", high);
}

std::string Range::words() const {
  constexpr double kLargest = std::numeric_limits<double>::max();
  std::string text;
  if (low != -kLargest) text = broken_by(-kLargest);
  if (high != kLargest) text += (text.empty() ? "" : ", ") + broken_by(kLargest);
  return text;
}

std::string missing(const Key& key) {
  const std::string unit = key.unit.empty() ? "" : fmt::format(" [{}]", key.unit);
  return fmt::format("{}{} is missing: {}", key.path, unit, key.help);
}

const Unit& unit_named(std::string_view name) {
  static constexpr std::array<Unit, 22> kUnits = {{
      {"", "1"},
      {"mm", "mm"},
      {"s", "s"},
      {"deg", "degree", core::kPi, 180.0},
      {"deg/mm", "degree mm-1", core::kPi, 180.0},
      {"rpm", "min-1", 1.0, 60.0},
      {"%", "percent", 1.0, 100.0},
      {"mm/min", "mm min-1", 1.0, 60.0},
      {"m/min", "m min-1", 1e3, 60.0},
      {"cm3/min", "cm3 min-1", 1e3, 60.0},
      {"N", "N"},
      {"N/s", "N s-1"},
      {"Hz", "Hz"},
      {"N/mm", "N mm-1"},
      {"N/mm2", "N mm-2"},
      {"N/mm3", "N mm-3"},
      {"N/mm2/deg", "N mm-2 degree-1", 180.0, core::kPi},
      {"N m", "N m", 1e3, 1.0},
      {"N/m", "N m-1", 1.0, 1e3},
      {"kg", "kg", 1.0, 1e3},
      {"1/kg", "kg-1", 1e3, 1.0},
      {"um", "um", 1.0, 1e3},
  }};
  const auto* const found = std::find_if(kUnits.begin(), kUnits.end(),
                                         [&](const Unit& unit) { return unit.name == name; });
  assert(found != kUnits.end());
  return *found;
}

Setting default_setting(const Key& key) {
  if (const auto* number = std::get_if<double>(&key.fallback)) return *number;
  if (const auto* text = std::get_if<std::string_view>(&key.fallback)) return std::string(*text);
  return {};
}

}  // namespace millstudy::study
