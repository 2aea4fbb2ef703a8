// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "force/edge.h"
#include "force/engagement.h"
#include "force/slice.h"

/// The edge of one tooth, which the reference kernel sums over teeth and the sampler prepares.
namespace millstudy::force {

/// Angles closer than this are one angle [rad]: at zero helix a whole tooth enters at one angle,
/// and whether 2 pi i / S + j pi is that angle must not depend on how it was rounded.
inline constexpr double kAngleSnap = 2.5e-14;

/// +1 where the tip leads (right hand and zero helix), -1 where it trails (left hand).
inline double hand(double helix_tangent) {
  return helix_tangent < 0.0 ? -1.0 : 1.0;
}

/// A lag angle from a lag per tangent, |tan(helix)| lambda [rad], kept off zero so that 0 / lag is
/// 0: zero helix is then the limit of small helix and needs no branch of its own.
inline double lag_over(double helix_tangent, double lag) {
  return std::max(std::abs(helix_tangent) * lag, std::numeric_limits<double>::min());
}

/// sin(x) / x.
inline double sinc(double x) {
  return x == 0.0 ? 1.0 : std::sin(x) / x;
}

/// How far the tip of a tooth is past the immersion angle that it meets first [rad], 0 .. 2 pi:
/// the entry for right hand, the exit, seen backward, for left hand.
double angle_past_first_limit(double helix_tangent, const Arc& arc, double tip_angle);

/// (F6): calls visit(z1, z2) for every interval of heights at which a tooth is in the material, in
/// ascending order; more than one where the depth is longer than the helix needs for a turn.
template <class Visit>
void for_each_engaged_interval(const CuttingEdges& edges, double helix_tangent, const Arc& arc,
                               double tip_angle, const Visit& visit) {
  const double depth = edges.axial_depth();
  const double all = edges.envelope().lag(depth);
  const double lag = lag_over(helix_tangent, all);
  const double width = arc.exit_angle - arc.entry_angle;
  const auto height = [&](double part) {
    return part >= 1.0 ? depth : std::min(depth, edges.envelope().height_at_lag(all * part));
  };
  double past = angle_past_first_limit(helix_tangent, arc, tip_angle);
  for (; past - width < lag; past += core::kTurn) {
    const double from = std::max(0.0, past - width) / lag;
    const double to = std::min(1.0, past / lag);
    if (from < to) visit(height(from), height(to));
  }
}

/// Adds the exact integral of one edge over the heights z1 .. z2: Gauss-Legendre (F10), on
/// cylinders the closed form (F9).
///
/// @param flute      whose pitch and helix angle count
/// @param tip_angle  immersion angle of the edge at z = 0 [rad]
void add_edge(Basis<double>& basis, const CuttingEdges& edges, int flute, double tip_angle,
              double z1, double z2);

/// Adds the part of one piece to a basis by Gauss-Legendre alone.
void add_piece(Basis<double>& basis, const CuttingEdges& edges, Rows rows, int flute,
               const EdgePiece& piece, double tip_angle, double z1, double z2);

/// Adds one node, whose immersion angle has this sine and cosine.
void add_node(Basis<double>& basis, const CuttingEdges& edges, Rows rows, int flute,
              const EdgeNode& node, double sin_phi, double cos_phi);

}  // namespace millstudy::force
