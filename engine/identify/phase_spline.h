// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace millstudy::identify {

/// The four cubic B-splines that are not zero at a time, (I4).
struct SplinePlace {
  int first = 0;                   ///< index of the first of them
  std::array<double, 4> weight{};  ///< their values; sum 1
};

/// @param part   of the record, 0 at its first sample, 1 at its last
/// @param count  of coefficients, >= 4
inline SplinePlace spline_place(double part, int count) {
  const double u = part * (count - 3);
  const int first = std::clamp(static_cast<int>(std::floor(u)), 0, count - 4);
  const double t = u - first, s = 1.0 - t;
  return {first,
          {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
           (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0}};
}

}  // namespace millstudy::identify
