// SPDX-License-Identifier: MIT
#include "identify/force_unit.h"

#include <algorithm>
#include <span>

namespace millstudy::identify {
namespace {

struct Unit {
  std::string_view name;
  double size;
};

// lbf: 0.45359237 kg at the standard acceleration 9.80665 m/s2 (both exact).
constexpr Unit kForce[] = {{"N", 1.0},
                           {"Newton", 1.0},
                           {"Newtons", 1.0},
                           {"newton", 1.0},
                           {"newtons", 1.0},
                           {"daN", 10.0},
                           {"kN", 1000.0},
                           {"mN", 1e-3},
                           {"lbf", 4.4482216152605},
                           {"lb", 4.4482216152605},
                           {"kgf", 9.80665}};
constexpr Unit kVoltage[] = {{"V", 1.0},    {"Volt", 1.0},  {"Volts", 1.0},
                             {"volt", 1.0}, {"volts", 1.0}, {"mV", 1e-3}};

std::optional<double> size_of(std::span<const Unit> units, std::string_view name) {
  constexpr std::string_view kAround = " \t[]()";
  const std::size_t first = name.find_first_not_of(kAround);
  if (first == std::string_view::npos) return {};
  name = name.substr(first, name.find_last_not_of(kAround) - first + 1);
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const Unit& unit) { return unit.name == name; });
  return found == units.end() ? std::nullopt : std::optional(found->size);
}

}  // namespace

std::optional<double> newtons_per(std::string_view unit) {
  return size_of(kForce, unit);
}

std::optional<double> volts_per(std::string_view unit) {
  return size_of(kVoltage, unit);
}

}  // namespace millstudy::identify
