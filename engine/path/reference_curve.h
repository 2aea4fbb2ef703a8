// SPDX-License-Identifier: MIT
#pragma once

#include "path/curve_data.h"
#include "path/curve_point.h"

namespace millstudy::path {

/// Cox-de Boor evaluation as the textbook has it: Piegl and Tiller, The NURBS Book, 2nd ed. 1997,
/// algorithms A2.1 (span by bisection), A2.3 (basis functions and derivatives) and A4.2 (the
/// quotient rule). Equations (P1), (P2).
///
/// The oracle of the tests and the baseline of the benchmark; Curve is the fast one. Accurate to
/// a few roundings of the largest control point (not of the local size: no local origin).
class ReferenceCurve {
 public:
  /// @throws core::InputError  with every fault of the data
  explicit ReferenceCurve(CurveData data);

  double begin() const { return data_.knots[data_.degree]; }
  double end() const { return data_.knots[data_.points.size()]; }

  /// R, R' and R'' at u, clamped into the domain; from the right at a knot, from the left at end().
  CurvePoint evaluate(double u) const { return evaluate(u, 2); }

  /// The same with derivatives up to `order` (0, 1 or 2); the others are zero.
  CurvePoint evaluate(double u, int order) const;

 private:
  CurveData data_;
};

}  // namespace millstudy::path
