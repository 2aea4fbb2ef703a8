// SPDX-License-Identifier: MIT
#include "study/quantity.h"

#include <array>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::study {
namespace {

struct Quantity {
  std::string_view name;
  std::string_view unit;
  bool needs_cutter;
  double (*native)(const Case&);
};

constexpr std::array<Quantity, 5> kQuantities = {{
    {"feed_per_tooth_mm", "mm", true, feed_per_tooth},
    {"feed_rate_mm_per_min", "mm/min", false, feed_rate},
    {"cutting_speed_m_per_min", "m/min", true, cutting_speed},
    {"radial_immersion", "", true, radial_immersion},
    {"material_removal_rate_cm3_per_min", "cm3/min", true, material_removal_rate},
}};

bool has_cutter(const Kind& kind) {
  return kind.find_key("cutter.diameter_mm") != nullptr;
}

}  // namespace

std::function<std::optional<double>(const Case&)> quantity_named(std::string_view name,
                                                                 const Kind& kind) {
  for (const Quantity& quantity : kQuantities) {
    if (quantity.name != name || (quantity.needs_cutter && !has_cutter(kind))) continue;
    const Unit& unit = unit_named(quantity.unit);
    return [native = quantity.native, &unit](const Case& point) -> std::optional<double> {
      return native(point) * unit.divisor / unit.factor;
    };
  }
  const Key* key = kind.find_key(name);
  if (!key || !key->numeric() || !key->field) return nullptr;
  return [key](const Case& point) { return read(*key, point); };
}

std::vector<std::string_view> quantity_names(const Kind& kind) {
  std::vector<std::string_view> names;
  for (const Quantity& quantity : kQuantities) {
    if (!quantity.needs_cutter || has_cutter(kind)) names.push_back(quantity.name);
  }
  return names;
}

}  // namespace millstudy::study
