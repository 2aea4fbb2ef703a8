// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "force/coefficients.h"
#include "force/edge.h"
#include "force/engagement.h"

namespace millstudy::force {

/// Largest sin(phi) within arcs; 0 without any.
double largest_sine(std::span<const Arc> arcs);

/// (F16): the thickest chip that each flute cuts [mm]; shape (N). 0 for one that misses every cut.
///
/// The chip grows with sin(phi) whatever the law, so only heights have to be searched: in closed
/// form where flutes have one helix angle, no runout and a feed in the plane; else by a scan and
/// golden sections, to 1e-7 of itself (measured).
///
/// @param sin_phi  the largest, see largest_sine()
std::vector<double> largest_chip_thickness(const CuttingEdges& edges, double sin_phi,
                                           const Feed& feed);

}  // namespace millstudy::force
