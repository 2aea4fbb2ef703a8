// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "dynamics/delay_system.h"
#include "dynamics/machine.h"
#include "dynamics/regenerative_cut.h"

namespace millstudy::dynamics {

/// A cut of which the depth is open.
using SystemAtDepth = std::function<DelaySystem(double axial_depth)>;

struct DepthSearch {
  double largest_depth = 10.0;  ///< up to where [mm], > 0
  double tolerance = 1e-3;      ///< of a boundary, relative; 1e-8 .. 0.1
  int samples = 24;   ///< depths looked at before boundaries are sought between them, >= 4
  int intervals = 0;  ///< if > 0: semi-discretization with so many intervals
  int order = 0;      ///< of the semi-discretization, 0 .. 2
};

/// Depths from .. to [mm] at which the cut is stable.
struct StableDepths {
  double from;
  double to;
};

struct DepthLimits {
  std::vector<StableDepths> stable;  ///< ascending; islands are intervals of their own
  /// The lowest boundary [mm]; largest_depth where all is stable, 0 where nothing is.
  double axial_depth_limit = 0.0;
  int evaluations = 0;  ///< spectral radii computed
  int level = 0;        ///< of the ladder of floquet(), for a next search to begin at
};

/// (D16): every interval of depth below the largest in which the spectral radius is below one.
///
/// Depths are sampled, denser where it is shallow; between two of different verdict the boundary
/// is found by regula falsi in the logarithm of the radius, and where three of one verdict have an
/// extremum that points across zero it is followed, so that an island between samples is found if
/// a parabola through its neighbours sees it. Every boundary is checked at a higher order of
/// collocation and found again there if it moves by more than the tolerance.
/// Measured: at half the tolerance limits move by less than the tolerance (200 random cuts).
/// @param first_level  of the ladder of floquet(), that of a neighbour
/// Throws core::InputError for a setting out of range.
DepthLimits depth_limits(const SystemAtDepth& system, const DepthSearch& search,
                         int first_level = 0);

}  // namespace millstudy::dynamics
