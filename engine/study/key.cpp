// SPDX-License-Identifier: MIT
#include "study/key.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <type_traits>

#include "core/units.h"

namespace millstudy::study {
namespace {

[[noreturn]] void refuse(const core::Value& value, std::string text) {
  throw core::InputError(value.place, std::move(text));
}

std::string quantity(double value, std::string_view unit) {
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

Setting checked_number(const Key& key, const core::Value& value) {
  if (!value.is_number()) {
    refuse(value,
           fmt::format("{} must be a {}, not {}", key.path,
                       key.type == KeyType::integer ? "whole number" : "number", type_name(value)));
  }
  const double number = value.number();
  const std::string shown = fmt::format("{} = {}", key.path, quantity(number, key.unit));
  if (!std::isfinite(number)) refuse(value, shown + " must be a finite number");
  if (key.type == KeyType::integer && number != std::nearbyint(number)) {
    refuse(value, shown + " must be a whole number");
  }
  if (!key.range.contains(number)) refuse(value, shown + " must be " + key.range.broken_by(number));
  return number;
}

}  // namespace

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

Setting checked_setting(const Key& key, const core::Value& value) {
  if (key.numeric()) return checked_number(key, value);
  if (key.type == KeyType::flag) {
    if (const bool* flag = std::get_if<bool>(&value.data)) return *flag;
    refuse(value, fmt::format("{} must be true or false, not {}", key.path, type_name(value)));
  }
  if (!value.is_string()) {
    refuse(value, fmt::format("{} must be a string, not {}", key.path, type_name(value)));
  }
  const bool known =
      key.type != KeyType::choice ||
      std::find(key.choices.begin(), key.choices.end(), value.string()) != key.choices.end();
  if (!known) {
    refuse(value, fmt::format("{} = \"{}\" must be one of {}", key.path, value.string(),
                              fmt::join(key.choices, ", ")));
  }
  return value.string();
}

const Unit& unit_named(std::string_view name) {
  static constexpr std::array<Unit, 13> kUnits = {{
      {"", "1"},
      {"mm", "mm"},
      {"s", "s"},
      {"deg", "degree", core::kPi, 180.0},
      {"rpm", "min-1", 1.0, 60.0},
      {"%", "percent", 1.0, 100.0},
      {"mm/min", "mm min-1", 1.0, 60.0},
      {"m/min", "m min-1", 1e3, 60.0},
      {"cm3/min", "cm3 min-1", 1e3, 60.0},
      {"N", "N"},
      {"N/mm", "N mm-1"},
      {"N/mm2", "N mm-2"},
      {"N m", "N m", 1e3, 1.0},
  }};
  const auto* const found = std::find_if(kUnits.begin(), kUnits.end(),
                                         [&](const Unit& unit) { return unit.name == name; });
  assert(found != kUnits.end());
  return *found;
}

void apply(const Key& key, const Setting& setting, Case& target) {
  const Unit& unit = unit_named(key.unit);
  const auto native = [&] { return std::get<double>(setting) * unit.factor / unit.divisor; };
  const auto choice = [&] {
    const auto at =
        std::find(key.choices.begin(), key.choices.end(), std::get<std::string>(setting));
    return static_cast<int>(at - key.choices.begin());
  };
  std::visit(
      [&]<class T>(T* field) {
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>) {
          *field = native();
        } else if constexpr (std::is_same_v<T, int>) {
          *field = static_cast<int>(std::get<double>(setting));
        } else if constexpr (std::is_same_v<T, CurvePtr>) {
          *field = std::get<CurvePtr>(setting);
        } else if constexpr (std::is_same_v<T, std::optional<Milling>>) {
          *field = static_cast<Milling>(choice());
        } else {
          *field = static_cast<T>(choice());
        }
      },
      key.field(target));
}

std::optional<double> read(const Key& key, const Case& source) {
  const Unit& unit = unit_named(key.unit);
  const auto shown = [&](double native) { return native * unit.divisor / unit.factor; };
  return std::visit(
      [&]<class T>(T* field) -> std::optional<double> {
        if constexpr (std::is_same_v<T, double>) {
          return shown(*field);
        } else if constexpr (std::is_same_v<T, int>) {
          return *field;
        } else if constexpr (std::is_same_v<T, std::optional<double>>) {
          if (field->has_value()) return shown(**field);
        }
        return std::nullopt;
      },
      key.field(const_cast<Case&>(source)));  // field() only says where; nothing is written
}

std::string to_string(const Setting& setting) {
  if (const double* number = std::get_if<double>(&setting)) return fmt::format("{}", *number);
  if (const bool* flag = std::get_if<bool>(&setting)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&setting)) return *text;
  return "curve";
}

}  // namespace millstudy::study
