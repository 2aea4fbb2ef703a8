// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/machine.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "force/variation.h"

namespace millstudy::dynamics {

struct TimeDomain {
  double feed_per_tooth = 0.05;  ///< [mm], >= 0
  bool tool_leaves_cut = true;   ///< no negative chips, and every tooth before counts
  int steps_per_cycle = 60;      ///< of the fastest mode, >= 10
  int discs = 0;          ///< of each piece of the edge; 0: so many that one lags by 5 deg at most
  int revolutions = 400;  ///< looked at before a verdict by what there is then, >= 10
  double process_damping = 0.0;  ///< C of (D26) [N/mm], >= 0
  double decades = 3.0;          ///< of growth or decay for an early verdict
};

/// What a simulated cut does.
struct Simulated {
  bool stable = false;
  bool saturated = false;        ///< it grew until the tool left the cut, or does not die
  double growth_per_turn = 0.0;  ///< of the disturbance, its logarithm
  int revolutions = 0;
  /// Positions x, y [mm] once a revolution, as the tip of flute 0 passes 0; shape (revolutions).
  std::vector<Eigen::Vector2d> once_per_turn;
  /// Positions x, y [mm] of the last turn, equally spaced from the tip of flute 0 at 0.
  std::vector<Eigen::Vector2d> last_turn;
};

/// (D23)-(D25): a cut step by step in time: modes by their exact exponential under the force at the
/// middle of the step; the edge in discs, each engaged for its share of the step; the chip against
/// what every tooth of the last two turns has left; runout, size effect.
///
/// It starts in the vibration that the cut would force without regeneration, which for equal
/// flutes is that of the cut itself, with a small disturbance added. The verdict is by growth of
/// the distance of one turn from the turn before, over samples of the position.
/// Second order in the step: against collocation the growth per turn is off by 2e-3 of a turn of
/// the fastest mode (measured on random cuts).
/// Throws core::InputError for what is out of range, and orthogonal data that vary with the chip.
Simulated simulate(const Machine& machine, const cutter::Cutter& cutter,
                   const force::Engagement& engagement, const force::Coefficients& coefficients,
                   double spindle_speed, const TimeDomain& settings,
                   const force::Variation& variation = {});

}  // namespace millstudy::dynamics
