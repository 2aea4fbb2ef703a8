// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "dynamics/mode.h"

namespace millstudy::dynamics {

/// A mode that moves along one machine axis. One of mass and stiffness is given, the other zero.
struct AxisMode {
  Mode mode;
  double mass = 0.0;       ///< modal [N s2/mm], 1 kg is 1e-3; > 0, or 0: from the stiffness
  double stiffness = 0.0;  ///< modal [N/mm], > 0, or 0: from the mass
};

/// A mode that couples the axes, by its residue matrix (D2).
struct ResidueMode {
  Mode mode;
  std::array<double, 4> residue{};  ///< R [mm/(N s2)]: xx, xy, yx, yy
};

/// How the tool moves against the workpiece under a force: modes of either or both sides.
struct Machine {
  std::vector<AxisMode> x;
  std::vector<AxisMode> y;
  std::vector<ResidueMode> coupled;
};

/// Throws core::InputError for a mode out of range, mass and stiffness both or neither, a residue
/// that is not finite or zero, and a machine without modes.
void check(const Machine& machine);

}  // namespace millstudy::dynamics
