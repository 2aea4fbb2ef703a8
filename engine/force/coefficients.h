// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

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

/// The steepest feed against the xy plane that forces are computed for [rad].
inline constexpr double kSteepestSlope = 15.0 * 3.14159265358979323846 / 180.0;

/// How the tool advances.
struct Feed {
  double per_tooth = 0.0;  ///< along the feed vector [mm], >= 0; the mean over the flutes
  double direction =
      0.0;             ///< theta of its part in the plane, counter-clockwise from machine x [rad]
  double slope = 0.0;  ///< up from the xy plane [rad], within +-kSteepestSlope

  double in_plane() const { return per_tooth * std::cos(slope); }
  double upward() const { return per_tooth * std::sin(slope); }
};

/// Chip columns, edge columns, plunge columns: what a force basis is multiplied with.
inline constexpr int kLoads = 9;
using Loads = std::array<double, kLoads>;

/// What multiplies the columns of a force basis, in the order of Coefficients: the feed in the
/// plane times the chip coefficients, the edge coefficients, the feed upward times the chip
/// coefficients.
inline Loads loads(const Coefficients& k, const Feed& feed) {
  const double f = feed.in_plane();
  const double up = feed.upward();
  return {f * k.Ktc, f * k.Krc, f * k.Kac, k.Kte, k.Kre, k.Kae, up * k.Ktc, up * k.Krc, up * k.Kac};
}

}  // namespace millstudy::force
