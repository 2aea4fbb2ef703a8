// SPDX-License-Identifier: MIT
#pragma once

#include "path/chord_step.h"

namespace millstudy::path {

/// Steps of the methods that newton is compared with. Each takes one step from `from` and ends at
/// the end of the curve where it would pass it; `ended` says so if the chord left is shorter than
/// the wanted one.

/// (P15). Error about half of the change of |R'| over the step.
ChordStep taylor1_step(const Curve& curve, const Stand& from, double chord);

/// (P16). Takes R'' at the start, which jumps at knots.
ChordStep taylor2_step(const Curve& curve, const Stand& from, double chord);

/// Parameter steps already taken, for the extrapolation; 0 for none.
struct StepHistory {
  double last = 0.0;         ///< u_i - u_(i-1)
  double before_last = 0.0;  ///< u_(i-1) - u_(i-2)
};

/// (P17). Needs at least one step of history.
ChordStep predictor_corrector_step(const Curve& curve, const Stand& from,
                                   const StepHistory& history, const ChordSettings& settings);

}  // namespace millstudy::path
