// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "core/units.h"
#include "force/lanes.h"

/// Elementary functions of the lanes, for the ranges that the samplers need.
namespace millstudy::force {

[[gnu::always_inline]] inline Lanes larger(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}

struct SineAndCosine {
  Lanes sine;
  Lanes cosine;
};

/// The angle in 0 .. pi of a vector whose y >= 0, to 5.2e-16 absolute (measured); of none it is
/// some finite number.
///
/// By the addition theorem from 0, pi/4 or pi/2 (Cephes), so that a polynomial in Chebyshev's
/// points is right to 1.5e-17, summed in pairs: one waits for the other as little as can be.
[[gnu::always_inline]] inline Lanes angle_of(const Lanes& x, const Lanes& y) {
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
  const Lanes size = x < 0.0 ? -x : x;
  const auto is_low = size < kTangentOfEighth * y;
  const auto is_high = kTangentOfEighth * size > y;
  const Lanes over = is_low ? size : is_high ? -y : size - y;
  const Lanes under = is_low ? y : is_high ? size : size + y;
  const Lanes from = is_low ? Lanes{} : (is_high ? Lanes{} + 0.5 : Lanes{} + 0.25) * core::kPi;
  const Lanes t = over / larger(under, Lanes{} + 1e-300);
  const Lanes t2 = t * t, t4 = t2 * t2, t8 = t4 * t4;
  const Lanes sum = ((k[0] + k[1] * t2) + (k[2] + k[3] * t2) * t4) +
                    t8 * (((k[4] + k[5] * t2) + (k[6] + k[7] * t2) * t4) +
                          t8 * ((k[8] + k[9] * t2) + k[10] * t4));
  const Lanes arc_tangent = from + t * sum;
  return 0.5 * core::kPi - (x < 0.0 ? -arc_tangent : arc_tangent);
}

/// Of an angle within +-1.6, to 3.8e-16 absolute (measured): Taylor's terms up to what adds
/// nothing, summed in pairs.
[[gnu::always_inline]] inline SineAndCosine sine_and_cosine(const Lanes& x) {
  static constexpr auto kTerms = [] {  // (-1)^(n/2) / n!
    std::array<double, 24> all{};
    double factorial = 1.0;
    for (int n = 0; n < 24; ++n) {
      factorial *= n > 0 ? n : 1;
      all[n] = (n / 2 % 2 == 0 ? 1.0 : -1.0) / factorial;
    }
    return all;
  }();
  const Lanes x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  const auto four = [&](int n) -> Lanes {
    return (kTerms[n] + kTerms[n + 2] * x2) + (kTerms[n + 4] + kTerms[n + 6] * x2) * x4;
  };
  return {x * (four(1) + x8 * (four(9) + x8 * four(17))), four(0) + x8 * (four(8) + x8 * four(16))};
}

}  // namespace millstudy::force
