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
/// Equation (M6) at the points, linear in arc length between them, rounded to 2^-32 per mm. On a
/// circle the error is that and 4 e / chord^2, e the rounding of the points; elsewhere it is of
/// second order in the chord (2e-6 per mm on an ellipse of 40 and 20 mm with chords of 0.1 mm), in
/// the first and last period of first order. Turns that could be rounding are none, and so is one
/// that goes straight back. Chords below 1e-3 of the longest are joined to their neighbours. A
/// corner is a turn within two or three periods.
///
/// @param reach  how far ahead turning_ahead looks [mm]; beyond its end the path goes on as it ends
/// @return shape (periods)
std::vector<Bend> bends_of(const path::Interpolation& path, double reach);

}  // namespace millstudy::process
