// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "path/curve_data.h"
#include "path/homogeneous.h"

namespace millstudy::path {

/// A polynomial piece on its way from control points to a Span.
struct Piece {
  double begin = 0.0;
  double end = 0.0;
  Vec3 origin;                      ///< the control points below are about this one [mm]
  std::vector<Homogeneous> bezier;  ///< homogeneous Bernstein form, shape (degree + 1)
  std::vector<Homogeneous> power;   ///< homogeneous power form about the middle, shape (degree + 1)
  double bend = 0.0;                ///< upper bound of |d2R/dt2| [mm]
};

/// The non-empty knot spans of a faultless curve as pieces whose weights vary at most fourfold.
///
/// Extraction by polar forms (Ramshaw 1989), in long double: it is done once for a curve.
std::vector<Piece> make_pieces(const CurveData& data);

}  // namespace millstudy::path
