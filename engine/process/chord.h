// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "path/interpolate.h"

namespace millstudy::process {

/// What the rounding of coordinates may move a point of a path by [mm].
double rounding_of(const path::Interpolation& path);

/// The motion of one interpolation period.
struct Chord {
  double length = 0.0;     ///< [mm]
  double direction = 0.0;  ///< theta of its part in the xy plane [rad], (M3)
  double slope = 0.0;      ///< up from the xy plane [rad], (M10); zero within rounding
};

/// The chord of period i.
///
/// @param rounding        rounding_of(path) [mm]
/// @param last_direction  theta where the tool rests in the plane [rad]
/// @throws core::CaseError if it climbs or descends by more than force::kSteepestSlope
Chord chord_of(const path::Interpolation& path, std::int64_t i, double rounding,
               double last_direction);

/// Direction of the first chord that moves in the plane [rad]; zero if there is none.
double first_direction(const path::Interpolation& path);

}  // namespace millstudy::process
