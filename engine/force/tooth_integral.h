// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "cutter/cutter.h"
#include "force/engagement.h"
#include "force/force_basis.h"

/// The edge of one tooth, which the reference kernel sums over teeth and the sampler prepares.
namespace millstudy::force {

/// Angles closer than this are one angle [rad]: at zero helix a whole tooth enters at one angle,
/// and whether 2 pi i / S + j pi is that angle must not depend on how it was rounded.
inline constexpr double kAngleSnap = 2.5e-14;

/// +1 where the tip leads (right hand and zero helix), -1 where it trails (left hand).
inline double hand(const cutter::Cutter& cutter) {
  return cutter.helix_angle < 0.0 ? -1.0 : 1.0;
}

/// Lag over a height, |k_theta| z [rad], kept off zero so that 0 / lag is 0: zero helix is then
/// the limit of small helix and needs no branch of its own.
inline double lag_over(const cutter::Cutter& cutter, double height) {
  return std::max(std::abs(cutter::lag_rate(cutter)) * height, std::numeric_limits<double>::min());
}

/// sin(x) / x.
inline double sinc(double x) {
  return x == 0.0 ? 1.0 : std::sin(x) / x;
}

/// How far the tip of a tooth is past the immersion angle that it meets first [rad], 0 .. 2 pi:
/// the entry for right hand, the exit, seen backward, for left hand.
double angle_past_first_limit(const cutter::Cutter& cutter, const Engagement& engagement,
                              double tip_angle);

/// (F6): calls visit(z1, z2) for every interval of heights at which a tooth is in the material, in
/// ascending order; more than one where the depth is longer than the helix needs for a turn.
template <class Visit>
void for_each_engaged_interval(const cutter::Cutter& cutter, const Engagement& engagement,
                               double tip_angle, const Visit& visit) {
  const double depth = engagement.axial_depth;
  const double lag = lag_over(cutter, depth);
  const double width = engagement.exit_angle - engagement.entry_angle;
  double past = angle_past_first_limit(cutter, engagement, tip_angle);
  for (; past - width < lag; past += 2.0 * core::kPi) {
    const double from = std::max(0.0, past - width) / lag;
    const double to = std::min(1.0, past / lag);
    if (from < to) visit(depth * from, depth * to);
  }
}

/// Adds the exact integral of one edge over the heights z1 .. z2: (F10) on the ball, (F9) above.
///
/// @param tip_angle  immersion angle of the edge at z = 0 [rad]
void add_edge(ForceBasis& basis, const cutter::Cutter& cutter, double tip_angle, double z1,
              double z2);

}  // namespace millstudy::force
