// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <random>

#include "dynamics/regenerative_cut.h"

/// Seeded random machines, cutters and cuts for the tests of dynamics/.
namespace millstudy::dynamics::testing {

struct RandomCut {
  Machine machine;
  cutter::Cutter cutter;
  force::Arc arc;
  force::Coefficients coefficients;
  double spindle_speed;          // [rad/s]
  double largest_depth;          // [mm]
  double process_damping = 0.0;  // [N/mm]

  DelaySystem at(double depth) const {
    return delay_system(machine, {cutter, {arc.entry_angle, arc.exit_angle, depth}, coefficients},
                        spindle_speed, process_damping);
  }
};

/// Flat, ball, bull-nose and tapered; one to six flutes, of equal and of unequal pitch and helix,
/// both hands; slots, up, down and interior arcs; one or two modes in x, none to two in y; half a
/// cycle to twelve of the first mode in a tooth period.
RandomCut random_cut(std::mt19937_64& random);

std::ostream& operator<<(std::ostream& out, const RandomCut& cut);

}  // namespace millstudy::dynamics::testing
