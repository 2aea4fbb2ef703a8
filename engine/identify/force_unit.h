// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace millstudy::identify {

/// Units that channels of forces can have, for messages.
inline constexpr std::string_view kForceUnits = "N, daN, kN, mN, lbf, kgf, V or mV";

/// [N] per unit, with or without brackets around it; nullopt: no unit of force.
std::optional<double> newtons_per(std::string_view unit);

/// [V] per unit; nullopt: no unit of voltage.
std::optional<double> volts_per(std::string_view unit);

}  // namespace millstudy::identify
