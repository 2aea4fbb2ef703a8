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

/// True if the comparison holds in any lane.
template <class Mask>
[[gnu::always_inline]] inline bool any(const Mask& mask) {
  long long found = 0;
  for (int i = 0; i < kLanes; ++i) found |= mask[i];
  return found != 0;
}

struct SineAndCosine {
  Lanes sine;
  Lanes cosine;
};

/// Sine and cosine of angles in 0 .. pi, to 3e-16 absolute (measured): Taylor series about pi/2.
[[gnu::always_inline]] inline SineAndCosine sine_and_cosine(const Lanes& angle) {
  // 1/n!, alternating, of cos (even n) and sin (odd n).
  static constexpr std::array<double, 12> kCosine = {1.0,
                                                     -1.0 / 2,
                                                     1.0 / 24,
                                                     -1.0 / 720,
                                                     1.0 / 40320,
                                                     -1.0 / 3628800,
                                                     1.0 / 479001600,
                                                     -1.0 / 87178291200.0,
                                                     1.0 / 20922789888000.0,
                                                     -1.0 / 6402373705728000.0,
                                                     1.0 / 2432902008176640000.0,
                                                     -1.0 / 1124000727777607680000.0};
  static constexpr std::array<double, 12> kSine = {1.0,
                                                   -1.0 / 6,
                                                   1.0 / 120,
                                                   -1.0 / 5040,
                                                   1.0 / 362880,
                                                   -1.0 / 39916800,
                                                   1.0 / 6227020800.0,
                                                   -1.0 / 1307674368000.0,
                                                   1.0 / 355687428096000.0,
                                                   -1.0 / 121645100408832000.0,
                                                   1.0 / 51090942171709440000.0,
                                                   -1.0 / 25852016738884976640000.0};
  const Lanes x = angle - 0.5 * core::kPi;
  const Lanes square = x * x;
  Lanes c = kCosine[11] + Lanes{};
  Lanes s = kSine[11] + Lanes{};
  for (int n = 10; n >= 0; --n) {
    c = c * square + kCosine[n];
    s = s * square + kSine[n];
  }
  return {c, -(s * x)};
}

/// An angle in 0 .. pi with its sine and cosine.
struct AngleLanes {
  Lanes angle;
  SineAndCosine of;
};

/// The angle in 0 .. pi whose cotangent is t, to 5e-16 absolute (measured); any t.
///
/// A polynomial to 1e-5 (Abramowitz and Stegun 4.4.49), then one step by the sine of what is left,
/// with the next term of the arc sine.
[[gnu::always_inline]] inline AngleLanes arc_cotangent(const Lanes& t) {
  const Lanes size = t < 0.0 ? -t : t;
  const Lanes part = size > 1.0 ? 1.0 / size : size;
  const Lanes square = part * part;
  const Lanes crude =
      part *
      (0.9998660 +
       square * (-0.3302995 + square * (0.1801410 + square * (-0.0851330 + square * 0.0208351))));
  const Lanes arc_tangent = size > 1.0 ? 0.5 * core::kPi - crude : crude;
  const Lanes near = t < 0.0 ? 0.5 * core::kPi + arc_tangent : 0.5 * core::kPi - arc_tangent;
  const SineAndCosine at = sine_and_cosine(near);
  // (t, 1), scaled where t is huge, is at the angle sought.
  const Lanes scale = 1.0 / square_root(1.0 + square);
  const Lanes y = scale * (size > 1.0 ? part : Lanes{} + 1.0);
  const Lanes x = scale * (size > 1.0 ? (t < 0.0 ? Lanes{} - 1.0 : Lanes{} + 1.0) : t);
  const Lanes rest = y * at.cosine - x * at.sine;
  return {near + rest * (1.0 + rest * rest * (1.0 / 6.0)), {y, x}};
}

}  // namespace millstudy::force
