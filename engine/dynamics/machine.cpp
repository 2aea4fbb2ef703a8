// SPDX-License-Identifier: MIT
#include "dynamics/machine.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"

namespace millstudy::dynamics {
namespace {

void check_axis(const char* axis, const std::vector<AxisMode>& modes) {
  for (const AxisMode& m : modes) {
    check(m.mode);
    const bool by_mass = std::isfinite(m.mass) && m.mass > 0.0 && m.stiffness == 0.0;
    const bool by_stiffness = std::isfinite(m.stiffness) && m.stiffness > 0.0 && m.mass == 0.0;
    if (!by_mass && !by_stiffness) {
      throw core::InputError(
          fmt::format("a mode in {} must have either a mass > 0 or a stiffness > 0, not mass = {} "
                      "N s2/mm and stiffness = {} N/mm",
                      axis, m.mass, m.stiffness));
    }
  }
}

}  // namespace

void check(const Machine& machine) {
  check_axis("x", machine.x);
  check_axis("y", machine.y);
  for (const ResidueMode& m : machine.coupled) {
    check(m.mode);
    const auto finite = [](double r) { return std::isfinite(r); };
    const auto zero = [](double r) { return r == 0.0; };
    if (!std::ranges::all_of(m.residue, finite) || std::ranges::all_of(m.residue, zero)) {
      throw core::InputError("the residue matrix of a mode must be finite and not zero");
    }
  }
  if (machine.x.empty() && machine.y.empty() && machine.coupled.empty()) {
    throw core::InputError("a machine must have at least one mode, in x or in y");
  }
}

}  // namespace millstudy::dynamics
