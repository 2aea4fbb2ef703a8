// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "force/lanes.h"

namespace millstudy::force {

/// (F29): heights u at which the phase of a chip may turn back, and where it goes fastest: between
/// them it goes one way, and by less than half a turn if the angle does by less than a quarter. So
/// the chip is zero once at most.
///
/// The chip is Re(conj(Z) exp(i angle)) with Z = z + u v, and its phase is the angle less that of
/// Z. It stands still where abs(Z)^2 = Im(conj(z) v) du/dangle, and goes fastest where Z is next to
/// the origin.
///
/// @tparam Value     double, or Lanes
/// @param z, v       real and imaginary part [mm], [1]
/// @param rise       du/dangle at u = 0 [mm/rad]
/// @param rise_slope  and how it grows with u [1/rad]: exact for the edges there are
/// @return [mm], not in order; the largest number where there is none
template <class Value>
[[gnu::always_inline]] inline std::array<Value, 3> heights_of_turning(const std::array<Value, 2>& z,
                                                                      const std::array<Value, 2>& v,
                                                                      double rise,
                                                                      double rise_slope) {
  const Value turn = z[0] * v[1] - z[1] * v[0], nearest = z[0] * v[0] + z[1] * v[1];
  const Value a = v[0] * v[0] + v[1] * v[1];
  const Value b = nearest - 0.5 * rise_slope * turn;
  const Value c = z[0] * z[0] + z[1] * z[1] - rise * turn;
  const Value square = b * b - a * c;
  const Value root = square_root(square > 0.0 ? square : Value{});
  const auto moves = a > 0.0;
  const Value per_a = 1.0 / (moves ? a : Value{} + 1.0);
  const Value none = Value{} + std::numeric_limits<double>::max();
  return {moves ? -nearest * per_a : none, moves ? (-b - root) * per_a : none,
          moves ? (root - b) * per_a : none};
}

}  // namespace millstudy::force
