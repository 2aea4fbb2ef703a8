// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>

#include "core/units.h"
#include "force/lanes.h"

/// Elementary functions of the lanes, for the ranges that the samplers need.
namespace millstudy::force {

[[gnu::always_inline]] inline Lanes smaller(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}

[[gnu::always_inline]] inline Lanes larger(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}

struct SineAndCosine {
  Lanes sine;
  Lanes cosine;
};

/// An angle in 0 .. pi with its sine and cosine.
struct AngleLanes {
  Lanes angle;
  SineAndCosine of;
};

/// The angle in 0 .. pi whose cotangent is t, to 5.2e-16 absolute (measured); any t.
///
/// By the addition theorem from 0, pi/4 or pi/2 (Cephes), so that a polynomial in Chebyshev's
/// points is right to 1.5e-17, summed in pairs: one waits for the other as little as can be.
[[gnu::always_inline]] inline AngleLanes arc_cotangent(const Lanes& t) {
  static constexpr std::array<double, 11> k = {1.0,
                                               -0.3333333333332844,
                                               0.19999999998855109,
                                               -0.14285714180976392,
                                               0.11111106180452865,
                                               -0.0909077307473686,
                                               0.07689953495298942,
                                               -0.06640233921673451,
                                               0.056883491809884175,
                                               -0.04348052083340628,
                                               0.021135371536498415};
  constexpr double kTangentOfEighth = 0.41421356237309505;  // of pi
  const Lanes size = t < 0.0 ? -t : t;
  const auto is_low = size < kTangentOfEighth;
  const auto is_high = size > 1.0 / kTangentOfEighth;
  const Lanes over = is_low ? size : is_high ? Lanes{} - 1.0 : size - 1.0;
  const Lanes under = is_low ? Lanes{} + 1.0 : is_high ? size : size + 1.0;
  const Lanes from = is_low ? Lanes{} : (is_high ? Lanes{} + 0.5 : Lanes{} + 0.25) * core::kPi;
  const Lanes x = over / under;
  const Lanes x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  const Lanes sum = ((k[0] + k[1] * x2) + (k[2] + k[3] * x2) * x4) +
                    x8 * (((k[4] + k[5] * x2) + (k[6] + k[7] * x2) * x4) +
                          x8 * ((k[8] + k[9] * x2) + k[10] * x4));
  const Lanes arc_tangent = from + x * sum;
  const Lanes angle = 0.5 * core::kPi - (t < 0.0 ? -arc_tangent : arc_tangent);
  // (t, 1) is at the angle; its square must be finite.
  const Lanes near = smaller(larger(t, Lanes{} - 1e100), Lanes{} + 1e100);
  const Lanes sine = 1.0 / square_root(1.0 + near * near);
  return {angle, {sine, sine * near}};
}

}  // namespace millstudy::force
