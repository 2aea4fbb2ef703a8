// SPDX-License-Identifier: MIT
#pragma once

#include "process/arc_set.h"
#include "process/bend.h"

namespace millstudy::process {

/// How the immersion follows the path.
struct Immersion {
  enum class Side {
    constant,  ///< the same angles everywhere: slots, angles given
    up,        ///< a wall on the left of the path (+y)
    down,      ///< a wall on the right
  };
  Side side = Side::constant;
  double radial_depth = 0.0;  ///< ae [mm], 0 < ae <= 2 R; not used by Side::constant
};

/// The radial depth that on a straight path has the immersion of this one on a bent path.
///
/// Equation (M5), limited to 0 (no cut) and 2 R (half a turn). Times the
/// path's length it is the area cut. Exact to rounding where path and wall are circles.
///
/// @param radius     R of the tool [mm], > 0
/// @param immersion  not Side::constant
/// @param curvature  k of the path in the xy plane [1/mm], positive turning left
/// @return [mm], 0 .. 2 R
double equivalent_radial_depth(double radius, const Immersion& immersion, double curvature);

/// Where the teeth cut on a bent path, one arc or none.
///
/// Equations (M5) and (M7). Without a bend the very bits of force::up_milling() or down_milling().
/// @throws core::InputError for a radial depth out of range
ArcSet immersed_arc(double radius, const Immersion& immersion, const Bend& bend);

}  // namespace millstudy::process
