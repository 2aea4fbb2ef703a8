// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "force/edge.h"

namespace millstudy::force {

/// Integrals over a stretch of an edge that give its force under a chip A cos(psi) + B sin(psi)
/// over sin(kappa), psi the lag, (F31); of all flutes of one helix.
struct StretchMoments {
  /// Of cos^2, cos sin and sin^2 of the lag.
  struct Second {
    double cc = 0.0, cs = 0.0, ss = 0.0;
  };
  /// Of cos and sin of the lag.
  struct First {
    double c = 0.0, s = 0.0;
  };
  std::array<Second, 3> chip{};     ///< weights sin(kappa) db times 1, sin(kappa), cos(kappa)
  std::array<First, 2> chip_up{};   ///< weights sin(kappa) db times cos(kappa), sin(kappa)
  std::array<First, 3> edge{};      ///< weights dS times 1, sin(kappa), cos(kappa)
  std::array<double, 2> edge_up{};  ///< weights dS times cos(kappa), sin(kappa)

  void add(const EdgeNode& node, double factor, double cos_lag, double sin_lag);
};

/// Moments with the weights above, and with these times z.
using MomentPair = std::array<StretchMoments, 2>;

/// By Gauss-Legendre (F10) over z1 .. z2 within a piece; without slopes the second is zero.
MomentPair moments_of(const CuttingEdges& edges, const EdgePiece& piece, double helix_tangent,
                      double z1, double z2, bool with_slopes);

/// Force along x, y, z for a coefficient of one; columns tangential, radial, axial.
using UnitForces = std::array<std::array<double, 3>, 3>;

/// Of the chip A cos(psi) + B sin(psi) at an edge whose tip is at an immersion angle.
UnitForces chip_forces(const StretchMoments& moments, double a, double b, double cos_tip,
                       double sin_tip);

/// Of the edge.
UnitForces edge_forces(const StretchMoments& moments, double cos_tip, double sin_tip);

}  // namespace millstudy::force
