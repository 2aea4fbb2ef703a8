// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cutter/envelope.h"
#include "force/chip_regimes.h"

namespace millstudy::force {

/// (F23): the chip under one reach is A cos(psi) + B sin(psi) over sin(kappa), psi the lag angle,
/// where all flutes have one helix angle and the axes are parallel.
struct ChipLine {
  double ratio = 0.0;    ///< w_m, feed since that tooth passed over the mean one [1]
  double cosines = 0.0;  ///< of the positions of both teeth, the difference
  double sines = 0.0;
  double a = 0.0;  ///< [mm]
  double b = 0.0;

  /// @param lag  cos and sin of it
  double at(const std::array<double, 2>& lag) const { return a * lag[0] + b * lag[1]; }
};

/// A stretch of an edge and the line that is the lowest there.
struct LineStretch {
  Regime regime;
  int line;
};

/// find_regimes() in closed form: walks up an edge along the lowest of the lines, and leaves out
/// where that is not positive. A single line is taken to be positive.
///
/// Two lines cross where their difference is zero, once over less than half a turn. Forces are
/// within 3e-15 of the peak of those by search (measured, 21,000 cases where lines vanish).
/// @param low, high  at most a turn of the lag angle apart; low.z < high.z
/// @param out        cleared and filled, ascending
void find_lowest(const cutter::Envelope& envelope, double helix_tangent,
                 std::span<const ChipLine> lines, const EdgePoint& low, const EdgePoint& high,
                 std::vector<LineStretch>& out);

}  // namespace millstudy::force
