// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/units.h"
#include "force/coefficients.h"
#include "force/lanes.h"
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
  Loads load;
  double cos_direction;
  double sin_direction;
  bool plunging;  ///< the plunge columns count only where the feed leaves the plane

  /// For a flute whose chips are this much thicker than the mean, (F21), while coefficients fall
  /// with powers of the chip, (F18).
  Combination with_chip(double ratio, const std::array<double, kColumns>& exponent) const {
    Combination other = *this;
    for (int column = 0; column < kColumns; ++column) {
      const double m = exponent[column];
      const double factor = m == 0.0 ? ratio : std::pow(ratio, 1.0 - m);
      other.load[column] *= factor;
      other.load[2 * kColumns + column] *= factor;
    }
    return other;
  }

  /// Turns the x and y of one row of forces.
  void turn(double* force) const {
    const double x = force[0];
    force[0] = x * cos_direction - force[1] * sin_direction;
    force[1] = x * sin_direction + force[1] * cos_direction;
  }
};

/// Rows of forces that still wait for feed and cutting-force coefficients: geometry only, laid out
/// for combine().
class PreparedRows {
 public:
  explicit PreparedRows(std::size_t rows = 0) : rows_(rows), padded_(padded(rows)) {
    for (std::vector<double>& column : columns_) column.assign(padded_, 0.0);
  }

  std::size_t rows() const { return rows_; }

  /// Forgets all but the first rows.
  void keep(std::size_t rows) {
    rows_ = rows;
    padded_ = padded(rows);
  }

  /// Adds factor times a basis to one row.
  void add(std::size_t row, const Basis<double>& basis, double factor) {
    for (int component = 0; component < kRows; ++component) {
      for (int column = 0; column < kLoads; ++column) {
        columns_[column][kRows * row + component] += factor * entry(basis, component, column);
      }
    }
  }

  /// Adds factor times other rows, of as many.
  void add(const PreparedRows& other, double factor) {
    for (int column = 0; column < kLoads; ++column) {
      for (std::size_t at = 0; at < padded_; ++at) {
        columns_[column][at] += factor * other.columns_[column][at];
      }
    }
  }

  /// One value, of component x, y, z, torque.
  double& at(std::size_t row, int component, int column) {
    return columns_[column][kRows * row + component];
  }

  /// Largest entry of a row over all loads.
  double largest(std::size_t row) const {
    double largest = 0.0;
    for (const std::vector<double>& column : columns_) {
      for (int i = 0; i < kRows; ++i) {
        largest = std::max(largest, std::abs(column[kRows * row + i]));
      }
    }
    return largest;
  }

  /// The rows under the loads, in machine axes, times factor. `to` holds padded() values.
  void combine(const Combination& with, double factor, double* to) const {
    with.plunging ? sum_columns<kLoads>(with.load, factor, to)
                  : sum_columns<kLoads - kColumns>(with.load, factor, to);
    for (std::size_t row = 0; row < rows_; ++row) with.turn(to + kRows * row);
  }

  std::size_t padded() const { return padded_; }

 private:
  /// Of so many columns: known when compiled, for that halves the time.
  template <int Columns>
  void sum_columns(const Loads& loads, double factor, double* to) const {
    Loads load_of = loads;
    for (double& value : load_of) value *= factor;
    for (std::size_t at = 0; at < padded_; at += kLanes) {
      Lanes sum{};
      for (int column = 0; column < Columns; ++column) {
        sum += load_of[column] * load(&columns_[column][at]);
      }
      std::memcpy(to + at, &sum, sizeof sum);
    }
  }

  static std::size_t padded(std::size_t rows) {
    return (kRows * rows + kLanes - 1) / kLanes * kLanes;
  }

  std::size_t rows_;
  std::size_t padded_;
  std::array<std::vector<double>, kLoads> columns_;  // each of shape (rows, kRows), padded
};

/// Coefficients of Harmonics: constant, cos1, sin1, cos2, sin2.
inline constexpr int kHarmonics = 5;

/// The five angles whose samples give harmonics, and the discrete Fourier transform that does.
struct HarmonicAngles {
  std::array<double, kHarmonics> cosine;
  std::array<double, kHarmonics> sine;
  std::array<std::array<double, kHarmonics>, kHarmonics> weight;  ///< [harmonic][sample]

  static const HarmonicAngles& get() {
    static const HarmonicAngles angles;
    return angles;
  }

 private:
  HarmonicAngles() {
    for (int i = 0; i < kHarmonics; ++i) {
      const double angle = core::kTurn * i / kHarmonics;
      cosine[i] = std::cos(angle);
      sine[i] = std::sin(angle);
      weight[0][i] = 1.0 / kHarmonics;
      weight[1][i] = 2.0 / kHarmonics * std::cos(angle);
      weight[2][i] = 2.0 / kHarmonics * std::sin(angle);
      weight[3][i] = 2.0 / kHarmonics * std::cos(2.0 * angle);
      weight[4][i] = 2.0 / kHarmonics * std::sin(2.0 * angle);
    }
  }
};

/// Harmonics of geometry only.
class HarmonicBasis {
 public:
  /// From a function basis(cos, sin of an angle) of the form above, by a discrete Fourier transform
  /// of five samples, which is exact for it.
  template <class Function>
  explicit HarmonicBasis(const Function& basis) : rows_(kHarmonics) {
    const HarmonicAngles& angles = HarmonicAngles::get();
    for (int i = 0; i < kHarmonics; ++i) {
      const Basis<double> sample = basis(angles.cosine[i], angles.sine[i]);
      for (int h = 0; h < kHarmonics; ++h) rows_.add(h, sample, angles.weight[h][i]);
    }
  }

  Harmonics combine(const Combination& with) const {
    std::array<double, kRows * kHarmonics + kLanes> values;
    rows_.combine(with, 1.0, values.data());
    std::array<double, kRows * kHarmonics> rows;
    std::copy_n(values.begin(), rows.size(), rows.begin());
    return std::bit_cast<Harmonics>(rows);
  }

 private:
  static_assert(sizeof(Harmonics) == kHarmonics * kRows * sizeof(double));
  PreparedRows rows_;
};

}  // namespace millstudy::force
