// SPDX-License-Identifier: MIT
#pragma once

#include "core/units.h"
#include "dynamics/regenerative_cut.h"

/// The example of T. Insperger, G. Stepan, Int. J. Numer. Meth. Engng 61 (2004) 117-141: one mode
/// in x, two flutes without helix.
namespace millstudy::dynamics::testing {

inline double spindle(double rpm) {
  return rpm * 2.0 * core::kPi / 60.0;
}

inline Machine insperger_machine() {
  Machine machine;
  machine.x.push_back({{922.0 * 2.0 * core::kPi, 0.011}, 0.03993e-3, 0.0});
  return machine;
}

inline constexpr force::Coefficients kInsperger = {600.0, 200.0, 0.0, 0.0, 0.0, 0.0};

inline cutter::Cutter insperger_cutter() {
  return {cutter::Shape::flat, 12.0, 2, 0.0};
}

inline DelaySystem insperger_slot(double rpm, double depth) {
  return delay_system(insperger_machine(), {insperger_cutter(), force::slot(depth), kInsperger},
                      spindle(rpm));
}

/// Down-milling at a radial immersion, radial depth over diameter.
inline DelaySystem insperger_down(double immersion, double rpm, double depth) {
  return delay_system(
      insperger_machine(),
      {insperger_cutter(), force::down_milling(6.0, 12.0 * immersion, depth), kInsperger},
      spindle(rpm));
}

}  // namespace millstudy::dynamics::testing
