// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

#include "core/units.h"
#include "path/interpolate.h"

/// Paths made by hand, for the tests of process/.
namespace millstudy::process::testing {

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

/// How many random cases: the usual number, times MILLSTUDY_RANDOM_FACTOR where it is set.
inline unsigned random_count(unsigned usual) {
  const char* factor = std::getenv("MILLSTUDY_RANDOM_FACTOR");
  return factor ? usual * static_cast<unsigned>(std::max(1, std::atoi(factor))) : usual;
}

inline path::Interpolation path_of(std::vector<path::Vec3> points) {
  path::Interpolation path;
  path.points = std::move(points);
  path.period = 0.002;
  return path;
}

/// Equal chords of the given length, turned by theta.
inline path::Interpolation straight(int periods, double chord, double theta) {
  std::vector<path::Vec3> points;
  for (int i = 0; i <= periods; ++i) {
    points.push_back({i * chord * std::cos(theta), i * chord * std::sin(theta), 0.0});
  }
  return path_of(std::move(points));
}

/// Equal chords on a circle, from the origin in direction theta.
/// @param curvature  not 0; positive turns left
inline path::Interpolation circle(int periods, double chord, double curvature, double theta) {
  const double turn = 2.0 * std::asin(0.5 * chord * curvature);
  std::vector<path::Vec3> points;
  for (int i = 0; i <= periods; ++i) {
    points.push_back({(std::sin(theta + i * turn) - std::sin(theta)) / curvature,
                      -(std::cos(theta + i * turn) - std::cos(theta)) / curvature, 0.0});
  }
  return path_of(std::move(points));
}

/// Straight, then straight on in another direction; the corner is a point.
inline path::Interpolation corner(int periods, double chord, double turn) {
  std::vector<path::Vec3> points;
  for (int i = -periods; i < 0; ++i) points.push_back({i * chord, 0.0, 0.0});
  for (int i = 0; i <= periods; ++i) {
    points.push_back({i * chord * std::cos(turn), i * chord * std::sin(turn), 0.0});
  }
  return path_of(std::move(points));
}

inline path::Interpolation reversed(path::Interpolation path) {
  return path_of({path.points.rbegin(), path.points.rend()});
}

/// Feed direction of a period.
inline double direction(const path::Interpolation& path, std::int64_t i) {
  return std::atan2(path.points[i + 1].y - path.points[i].y,
                    path.points[i + 1].x - path.points[i].x);
}

/// Where the tool meets an immersion angle, in machine axes, from the middle of period i.
inline path::Vec3 on_tool(const path::Interpolation& path, std::int64_t i, double radius,
                          double phi) {
  const path::Vec3 middle = 0.5 * (path.points[i] + path.points[i + 1]);
  const double angle = direction(path, i) + 0.5 * core::kPi - phi;  // clockwise from the left
  return middle + radius * path::Vec3{std::cos(angle), std::sin(angle), 0.0};
}

}  // namespace millstudy::process::testing
