// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "path/reference_curve.h"

namespace millstudy::path::baseline {

struct PlainPath {
  std::vector<Vec3> points;
  std::vector<double> parameters;
};

/// The baseline of the interpolator: the paper's algorithm as one would write it from the paper and
/// The NURBS Book. Cox-de Boor evaluation with first derivatives (A2.1, A2.3, A4.2), knot span by
/// bisection, no allocation in the loop, the last evaluation of a step reused as the start of the
/// next, and no safeguard of any kind. N updates cost N + 1 evaluations, as they do in the engine.
inline PlainPath plain_newton(const ReferenceCurve& curve, double chord, int iterations,
                              std::size_t expected_points) {
  PlainPath path;
  path.points.reserve(expected_points);
  path.parameters.reserve(expected_points);
  double u = curve.begin();
  CurvePoint here = curve.evaluate(u, 1);
  path.points.push_back(here.position);
  path.parameters.push_back(u);
  for (;;) {
    double next = u + chord / norm(here.first);
    CurvePoint there = curve.evaluate(next, 1);
    for (int n = 0; n < iterations; ++n) {
      const Vec3 reach = there.position - here.position;
      const double length = norm(reach);
      next += (chord - length) * length / dot(reach, there.first);
      there = curve.evaluate(next, 1);
    }
    if (!(next < curve.end())) break;
    u = next;
    here = there;
    path.points.push_back(here.position);
    path.parameters.push_back(u);
  }
  path.points.push_back(curve.evaluate(curve.end(), 0).position);
  path.parameters.push_back(curve.end());
  return path;
}

}  // namespace millstudy::path::baseline
