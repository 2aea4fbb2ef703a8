// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "cutter/cutter.h"
#include "cutter/envelope.h"

namespace millstudy::force {

/// One of n discs of equal height, taken at its mid-height (F12).
struct Disc {
  double height;       ///< dz [mm]
  double edge_length;  ///< dS [mm]
  double sin_kappa;
  double cos_kappa;
  double radius;     ///< r [mm]
  double lag_angle;  ///< psi [rad]
};

/// Disc i of n, 0 <= i < n, of a cut of the given axial depth [mm].
inline Disc disc_at(const cutter::Cutter& cutter, double axial_depth, int n, int i) {
  const double height = axial_depth / n;
  const double z = (i + 0.5) * height;
  const cutter::EnvelopePoint point = cutter::envelope(cutter, z);
  const double sin_kappa = std::sin(point.kappa);
  if (z >= cutter::curved_height(cutter)) {
    const double length = height * cutter::edge_length_rate(cutter);
    return {height, length, 1.0, 0.0, point.radius, point.lag_angle};
  }
  const double length = height * cutter::curved_edge_per_width(cutter, sin_kappa) / sin_kappa;
  return {height, length, sin_kappa, std::cos(point.kappa), point.radius, point.lag_angle};
}

}  // namespace millstudy::force
