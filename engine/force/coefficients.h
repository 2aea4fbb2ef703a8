// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace millstudy::force {

/// Cutting-force coefficients of a pair of tool and material: chip part in proportion to chip
/// area, edge part in proportion to edge length (F2).
struct Coefficients {
  double Ktc = 0.0;  ///< tangential, chip [N/mm2]
  double Krc = 0.0;  ///< radial, chip [N/mm2]
  double Kac = 0.0;  ///< axial, chip [N/mm2]
  double Kte = 0.0;  ///< tangential, edge [N/mm]
  double Kre = 0.0;  ///< radial, edge [N/mm]
  double Kae = 0.0;  ///< axial, edge [N/mm]
};

/// What multiplies the six columns of a force basis: feed times the chip coefficients, then the
/// edge coefficients, in the order of Coefficients.
inline std::array<double, 6> loads(const Coefficients& k, double feed_per_tooth) {
  return {
      feed_per_tooth * k.Ktc, feed_per_tooth * k.Krc, feed_per_tooth * k.Kac, k.Kte, k.Kre, k.Kae};
}

}  // namespace millstudy::force
