// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "cutter/cutter.h"

namespace millstudy::cutter {

/// The cutting edge at one height above the tip.
struct EnvelopePoint {
  double radius;     ///< r, distance from the tool axis [mm]
  double kappa;      ///< axial immersion angle, normal against the tool axis [rad], 0 .. pi/2
  double lag_angle;  ///< psi, how far this point trails the tip [rad]; negative for left hand
};

/// (C3)-(C6) for flat and (C7)-(C9) for ball; above the ball the cylinder of (C3).
///
/// @param z  height above the tip [mm], >= 0
/// @return exact to rounding, relative to each member, also next to the tip
EnvelopePoint envelope(const Cutter& cutter, double z);

/// Height below which the envelope is curved [mm]: 0 for flat, R for ball.
double curved_height(const Cutter& cutter);

/// (C10): edge length per height, dS/dz, on the cylindrical part [1].
///
/// For flat it is 1, the reading of the paper's (22) and (26); on the cylinder above a ball it is
/// 1/cos(helix), to which (C12) leads continuously.
double edge_length_rate(const Cutter& cutter);

/// (C12), which is (C2) over (C6): edge length per chip width, dS/db, on a ball [1]. Exact to
/// rounding.
///
/// @param helix_tangent  tan(helix), of either sign; it stays the same all along the edge
/// @param sin_kappa      0 .. 1
inline double ball_edge_per_width(double helix_tangent, double sin_kappa) {
  const double bend = helix_tangent * sin_kappa * sin_kappa;
  return std::sqrt(1.0 + bend * bend);
}

/// Edge length per chip width, dS/db, on the curved part: (C12) for ball [1].
///
/// @param sin_kappa  0 .. 1
double curved_edge_per_width(const Cutter& cutter, double sin_kappa);

/// (C11): integral of r from the tip to a height [mm2].
///
/// Times (cos entry_angle - cos exit_angle) it is the section swept by the cut, and that times the
/// feed rate the material removal rate. Error below 1e-15 R^2 (measured).
/// @param depth  height above the tip [mm], >= 0
double section_area(const Cutter& cutter, double depth);

/// Largest sin(kappa) below a height [1]; the chip is thickest there. For flat and ball it is the
/// one at that height, for kappa nowhere falls.
/// @param depth  height above the tip [mm], >= 0
double largest_sin_kappa(const Cutter& cutter, double depth);

}  // namespace millstudy::cutter
