// SPDX-License-Identifier: MIT
#include "process/immersion.h"

#include <algorithm>
#include <cassert>

#include "core/units.h"
#include "force/engagement.h"

namespace millstudy::process {
namespace {

/// acos(1 - ae/R), zero without a radial depth.
double immersed_angle(double radius, double radial_depth) {
  constexpr double kAnyDepth = 1.0;
  return radial_depth > 0.0 ? force::up_milling(radius, radial_depth, kAnyDepth).exit_angle : 0.0;
}

}  // namespace

double equivalent_radial_depth(double radius, const Immersion& immersion, double curvature) {
  assert(immersion.side != Immersion::Side::constant);
  const double towards_wall = immersion.side == Immersion::Side::up ? curvature : -curvature;
  const double depth = immersion.radial_depth;
  return std::clamp(depth * (1.0 - towards_wall * (radius - 0.5 * depth)), 0.0, 2.0 * radius);
}

ArcSet immersed_arc(double radius, const Immersion& immersion, const Bend& bend) {
  const double straight =
      force::up_milling(radius, immersion.radial_depth, 1.0).exit_angle;  // checks the depth
  const double bent =
      immersed_angle(radius, equivalent_radial_depth(radius, immersion, bend.curvature));
  const double angle = std::min(
      std::clamp(bent, straight - bend.turning_ahead, straight + bend.turning_ahead),  // (M7)
      core::kPi);
  ArcSet arcs;
  if (immersion.side == Immersion::Side::up) {
    arcs.add({0.0, angle});
  } else {
    arcs.add({core::kPi - angle, core::kPi});
  }
  return arcs;
}

}  // namespace millstudy::process
