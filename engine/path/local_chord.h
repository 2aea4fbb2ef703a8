// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "path/homogeneous.h"

namespace millstudy::path {

/// The chord from a place as a function of the step s in t, as long as both ends are in one span.
///
/// With the curve expanded about the place, R(t + s) - R(t) = s (E1 + E2 s + ...) / w(s), so the
/// squared chord is s^2 Q(s) / w(s)^2 with Q a polynomial of degree 2 (degree - 1): equation (P10).
/// One value of Q is to the Newton update (P8) what one evaluation of the curve is, and the updates
/// are the same to rounding, in two thirds of the time (57 for
/// 92 ns a step on Table 1): an update waits for one square root, the division
/// runs beside it, and no vector is summed up. Nor is the chord a difference of coordinates.
///
/// The loops are unrolled by order: at -O2 GCC would keep the small arrays in memory, which is
/// slower.
template <int kDegree, bool kRational>
class LocalChord {
 public:
  /// @param c  homogeneous power form of the span, shape (kDegree + 1)
  /// @param t  the place
  [[gnu::always_inline]] LocalChord(const Homogeneous* c, double t) {
    std::array<Homogeneous, kDegree + 1> d;
#pragma GCC unroll 16
    for (int i = 0; i <= kDegree; ++i) d[i] = c[i];
#pragma GCC unroll 16
    for (int j = 0; j < kDegree; ++j) {  // expansion about t by repeated synthetic division
#pragma GCC unroll 16
      for (int i = kDegree - 1; i >= j; --i) d[i] = d[i] + d[i + 1] * t;
    }
    if constexpr (kRational) {
      const double inverse = 1.0 / d[0].w();
#pragma GCC unroll 16
      for (Homogeneous& e : d) e = e * inverse;
      weight_[0] = 1.0;
#pragma GCC unroll 16
      for (int i = 1; i <= kDegree; ++i) {
        weight_[i] = d[i].w();
        d[i] = d[i] - d[0] * weight_[i];  // E_i, w is 0
      }
    }
#pragma GCC unroll 16
    for (int i = 1; i <= kDegree; ++i) {
      add(2 * i - 2, i * i, dot(d[i], d[i]));
#pragma GCC unroll 16
      for (int j = i + 1; j <= kDegree; ++j) add(i + j - 2, i * j, 2.0 * dot(d[i], d[j]));
    }
#pragma GCC unroll 16
    for (int k = 0; k < 2 * kDegree - 1; ++k) growth_[k] = (1.0 + 0.5 * k) * square_[k];
  }

  /// |dR/dt|^2 at t + s, if not rational. The next step starts from it: it is there one evaluation
  /// of the curve earlier than dR/dt itself.
  double speed_squared(double s) const {
    return horner(speed_, s);
  }

  struct Value {
    double length;  ///< |R(t + s) - R(t)| [mm]
    double growth;  ///< > 0 where the chord grows with s
    double update;  ///< what Newton adds to s, (P8)
  };

  [[gnu::always_inline]] Value at(double s, double chord) const {
    const double square = horner(square_, s);
    const double growth = horner(growth_, s);
    const double root = std::sqrt(square);
    if constexpr (kRational) {
      double weight = weight_[kDegree];
      double slope = weight;
      weight = weight * s + weight_[kDegree - 1];
#pragma GCC unroll 16
      for (int i = kDegree - 2; i >= 0; --i) {
        slope = slope * s + weight;
        weight = weight * s + weight_[i];
      }
      const double rise = growth * weight - s * square * slope;
      const double inverse = weight / rise;
      return {s * root / weight, rise, (chord * weight * root - s * square) * inverse};
    } else {
      const double inverse = 1.0 / growth;
      return {s * root, growth, (chord * root - s * square) * inverse};
    }
  }

 private:
  void add(int k, int factor, double product) {
    square_[k] += product;
    speed_[k] += factor * product;
  }

  template <std::size_t n>
  static double horner(const std::array<double, n>& c, double s) {
    double value = c[n - 1];
#pragma GCC unroll 16
    for (int i = static_cast<int>(n) - 2; i >= 0; --i) value = value * s + c[i];
    return value;
  }

  std::array<double, 2 * kDegree - 1> square_{};  // Q
  std::array<double, 2 * kDegree - 1> growth_{};  // Q + s Q' / 2
  std::array<double, 2 * kDegree - 1> speed_{};   // |E1 + 2 E2 s + ...|^2
  std::array<double, kDegree + 1> weight_{};      // w(t + s) / w(t)
};

}  // namespace millstudy::path
