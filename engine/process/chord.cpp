// SPDX-License-Identifier: MIT
#include "process/chord.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "force/coefficients.h"

namespace millstudy::process {

double rounding_of(const path::Interpolation& path) {
  // Points are within 4e-14 of the size of the control polygon, see path::Curve.
  constexpr double kRounding = 1e-13;
  double size = 0.0;
  for (const path::Vec3& point : path.points) {
    size = std::max({size, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
  }
  return kRounding * size;
}

Chord chord_of(const path::Interpolation& path, std::int64_t i, double rounding,
               double last_direction) {
  const path::Vec3 way = path.points[i + 1] - path.points[i];
  const double in_plane = std::hypot(way.x, way.y);
  Chord chord;
  chord.length = std::hypot(in_plane, way.z);
  chord.direction = in_plane > 0.0 ? std::atan2(way.y, way.x) : last_direction;
  if (std::abs(way.z) <= rounding) return chord;
  if (std::abs(way.z) > in_plane * std::tan(force::kSteepestSlope) + rounding) {
    throw core::CaseError(
        "the path climbs by more than 15 deg: forces are computed for slopes up to 15 deg, up or "
        "down");
  }
  chord.slope =
      std::clamp(std::atan2(way.z, in_plane), -force::kSteepestSlope, force::kSteepestSlope);
  return chord;
}

double first_direction(const path::Interpolation& path) {
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const path::Vec3 way = path.points[i] - path.points[i - 1];
    if (way.x != 0.0 || way.y != 0.0) return std::atan2(way.y, way.x);
  }
  return 0.0;
}

}  // namespace millstudy::process
