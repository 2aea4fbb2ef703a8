// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "core/units.h"
#include "force/slice.h"

namespace millstudy::force {

/// A force row by row, as c0 + c1 cos(a) + s1 sin(a) + c2 cos(2a) + s2 sin(2a): five coefficients
/// for each of the rows x, y, z, torque. Forces of a fixed piece of edge are all of this form
/// (F11), and z and torque have no second harmonic.
struct Harmonics {
  using Row = std::array<double, kRows>;
  Row constant{};
  Row cos1{};
  Row sin1{};
  Row cos2{};
  Row sin2{};
};

/// p(a + shift) as harmonics of a.
inline Harmonics shifted(const Harmonics& p, double cos_shift, double sin_shift) {
  const double cos_twice = cos_shift * cos_shift - sin_shift * sin_shift;
  const double sin_twice = 2.0 * sin_shift * cos_shift;
  Harmonics q;
  q.constant = p.constant;
  for (int row = 0; row < kRows; ++row) {
    q.cos1[row] = p.cos1[row] * cos_shift + p.sin1[row] * sin_shift;
    q.sin1[row] = p.sin1[row] * cos_shift - p.cos1[row] * sin_shift;
    q.cos2[row] = p.cos2[row] * cos_twice + p.sin2[row] * sin_twice;
    q.sin2[row] = p.sin2[row] * cos_twice - p.cos2[row] * sin_twice;
  }
  return q;
}

/// What a call multiplies the prepared geometry with: feed and coefficients (see loads()), and the
/// direction of the feed frame into whose machine axes x and y are turned back.
struct Combination {
  std::array<double, 2 * kColumns> load;
  double cos_direction;
  double sin_direction;

  /// Turns the x and y of one row of forces.
  void turn(std::array<double, kRows>& force) const {
    const double x = force[0];
    force[0] = x * cos_direction - force[1] * sin_direction;
    force[1] = x * sin_direction + force[1] * cos_direction;
  }

  /// The force (rows x, y, z, torque) of a basis in machine axes.
  std::array<double, kRows> operator()(const Basis<double>& basis) const {
    std::array<double, kRows> force = apply(basis, load);
    turn(force);
    return force;
  }
};

/// Harmonics whose coefficients still wait for feed and cutting-force coefficients: geometry only.
class HarmonicBasis {
 public:
  HarmonicBasis() = default;

  /// From a function basis(angle) of the form above, by a discrete Fourier transform of five
  /// samples, which is exact for it.
  template <class Function>
  explicit HarmonicBasis(const Function& basis) {
    constexpr int kSamples = 5;
    for (int i = 0; i < kSamples; ++i) {
      const double angle = 2.0 * core::kPi * i / kSamples;
      const Basis<double> sample = basis(angle);
      add(constant_, sample, 1.0 / kSamples);
      add(cos1_, sample, 2.0 / kSamples * std::cos(angle));
      add(sin1_, sample, 2.0 / kSamples * std::sin(angle));
      add(cos2_, sample, 2.0 / kSamples * std::cos(2.0 * angle));
      add(sin2_, sample, 2.0 / kSamples * std::sin(2.0 * angle));
    }
  }

  Harmonics combine(const Combination& with) const {
    return {with(constant_), with(cos1_), with(sin1_), with(cos2_), with(sin2_)};
  }

 private:
  static void add(Basis<double>& sum, const Basis<double>& term, double factor) {
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        sum.chip[row][column] += factor * term.chip[row][column];
        sum.edge[row][column] += factor * term.edge[row][column];
      }
    }
  }

  Basis<double> constant_;
  Basis<double> cos1_;
  Basis<double> sin1_;
  Basis<double> cos2_;
  Basis<double> sin2_;
};

}  // namespace millstudy::force
