// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "path/curve_data.h"
#include "path/homogeneous.h"

namespace millstudy::path {

/// Control points of one polynomial piece in Bernstein form; the first degree + 1 are in use.
using BezierPoints = std::array<Homogeneous, kHighestDegree + 1>;

struct BezierHalves {
  BezierPoints left;
  BezierPoints right;
};

/// De Casteljau: the piece cut at s in [0, 1] of its length, equation (P4).
inline BezierHalves split(const BezierPoints& piece, int degree, double s) {
  BezierHalves halves{piece, piece};
  for (int level = 1; level <= degree; ++level) {
    for (int i = 0; i <= degree - level; ++i) {
      halves.right[i] = halves.right[i] * (1.0 - s) + halves.right[i + 1] * s;
    }
    halves.left[level] = halves.right[0];
  }
  return halves;
}

}  // namespace millstudy::path
