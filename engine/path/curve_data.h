// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "path/vec3.h"

namespace millstudy::path {

inline constexpr int kHighestDegree = 15;

/// A rational B-spline as it stands in a file.
///
/// The domain is [knots[degree], knots[points.size()]]: clamped ends (degree + 1 equal knots) are
/// usual and not needed. Interior knots may repeat.
struct CurveData {
  int degree = 0;               ///< 1 to kHighestDegree
  std::vector<double> knots;    ///< non-decreasing, shape (points + degree + 1)
  std::vector<Vec3> points;     ///< control points [mm], shape (points)
  std::vector<double> weights;  ///< > 0, shape (points); empty means all 1
};

/// Everything wrong with a curve, one plain line for each fault; empty if a Curve can be made.
std::vector<std::string> faults(const CurveData& data);

/// Knots 0 x (degree + 1), 1 x (degree + 1) of a Bezier curve, shape (2 degree + 2).
std::vector<double> bezier_knots(int degree);

/// Clamped knots on [0, 1] with equal spans, shape (points + degree + 1); points > degree.
std::vector<double> clamped_uniform_knots(int degree, int points);

}  // namespace millstudy::path
