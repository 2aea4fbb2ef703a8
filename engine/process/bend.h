// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "path/interpolate.h"

namespace millstudy::process {

/// How a path bends in the xy plane, in one interpolation period.
struct Bend {
  double curvature = 0.0;      ///< k at the middle [1/mm], positive turning left
  double turning_ahead = 0.0;  ///< sum of |turn| that the tool reaches from there [rad]
};

/// The bend of every period, from the turning between chords.
///
/// Equation (M6) at the points, linear in arc length between them. Exact on a circle to rounding,
/// e_k = 4 e / chord^2 with e the rounding of the points; elsewhere the error is of second order in
/// the chord, in the first and last period of first order. Turns that could be rounding are none,
/// and so is one that goes straight back. Chords below 1e-3 of the longest are joined to their
/// neighbours. A corner is a turn within two or three periods.
///
/// @param reach  how far ahead turning_ahead looks [mm]; beyond its end the path goes on as it ends
/// @return shape (periods)
std::vector<Bend> bends_of(const path::Interpolation& path, double reach);

}  // namespace millstudy::process
