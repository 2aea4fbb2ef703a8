// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "force/chip_law.h"

namespace millstudy::force {

/// A stretch of an edge, at one spindle angle, over which one reach decides the chip.
struct Regime {
  double bottom;  ///< [mm]
  double top;     ///< [mm]
};

/// Splits z1 .. z2 of a piece where the tooth that left the surface changes, and leaves out where
/// there is no chip: within each stretch the chip thickness is smooth.
///
/// Each pair of reaches crosses at most once over an engaged interval where all flutes have one
/// helix angle and the axes are parallel: over sin(phi) all are linear in cot(phi), (F23). With a
/// tilt, and up to eight teeth, it does between heights that are known, (F29). The lower envelope
/// is then found exactly; in other cases for sixteen parts of the interval one by one, with a look
/// at their middles and where parabolas come next to zero: of 1.7 million random teeth it was that
/// of 512 parts.
///
/// @param tip_angle  immersion angle of the flute's edge at z = 0 [rad]
/// @param out        cleared and filled, ascending
void find_regimes(const CuttingEdges& edges, const ChipLaw& law, const Feed& feed, int flute,
                  const EdgePiece& piece, double tip_angle, double z1, double z2,
                  std::vector<Regime>& out);

}  // namespace millstudy::force
