// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/units.h"
#include "force/lanes.h"

/// Series of functions of a part, 0 .. 1, of something.
namespace millstudy::force {

/// The variable t, -1 .. 1, in which a function of a part is a series: in proportion to
/// sqrt(base + part), or to the part itself for a function that has no root.
class SeriesVariable {
 public:
  static SeriesVariable of_root(double base) { return SeriesVariable(base); }
  static SeriesVariable linear() { return SeriesVariable(std::numeric_limits<double>::infinity()); }

  double part_at(double t) const {
    if (is_linear()) return 0.5 + 0.5 * t;
    const double root = low_ + (0.5 + 0.5 * t) * (high_ - low_);
    return root * root - base_;
  }

  [[gnu::always_inline]] Lanes at(const Lanes& part) const {
    if (is_linear()) return 2.0 * part - 1.0;
    return scale_ * (square_root(base_ + part) - low_) - 1.0;
  }

 private:
  explicit SeriesVariable(double base)
      : base_(base),
        low_(std::sqrt(base)),
        high_(std::sqrt(base + 1.0)),
        scale_(2.0 / (high_ - low_)) {}

  bool is_linear() const { return std::isinf(base_); }

  double base_;
  double low_;    // of the root, at part 0
  double high_;   // at part 1
  double scale_;  // of t over the root
};

/// Nodes cos(pi (i + 1/2) / count), and what the values there weigh in the terms of a Chebyshev
/// series.
class ChebyshevNodes {
 public:
  /// As many as series are tried with, one after the other.
  static constexpr std::array<int, 3> kCounts = {24, 48, 96};

  /// @param count  one of kCounts
  static const ChebyshevNodes& of(int count) {
    static const std::array<ChebyshevNodes, 3> all = {
        ChebyshevNodes(kCounts[0]), ChebyshevNodes(kCounts[1]), ChebyshevNodes(kCounts[2])};
    return all[count == kCounts[0] ? 0 : count == kCounts[1] ? 1 : 2];
  }

  double node(int i) const { return nodes_[i]; }
  /// That of the node opposite, count - 1 - i, is the same, of odd terms its negative.
  double weight(int term, int i) const { return weights_[term * count_ + i]; }

 private:
  explicit ChebyshevNodes(int count) : count_(count) {
    for (int term = 0; term < count; ++term) {
      for (int i = 0; i < count; ++i) {
        const double turned = term * (2 * i + 1) % (4 * count);
        weights_.push_back((term == 0 ? 1.0 : 2.0) / count *
                           std::cos(0.5 * core::kPi * turned / count));
      }
    }
    for (int i = 0; i < count; ++i) nodes_.push_back(std::cos(core::kPi * (i + 0.5) / count));
  }

  int count_;
  std::vector<double> nodes_;
  std::vector<double> weights_;  ///< shape (terms, nodes)
};

/// What the terms of a series are factors of. Powers take half the time, and lose digits where a
/// series falls slowly.
enum class Terms { chebyshev, powers };

/// Sums the first kSeries of kStride series at every t: eight sums abreast keep a processor busy,
/// of which each waits for its own last product.
///
/// @param terms  shape (count, kStride)
template <int kSeries, int kStride, std::size_t kVectors>
[[gnu::always_inline]] inline std::array<std::array<Lanes, kSeries>, kVectors> sum_series(
    Terms kind, const double* terms, std::size_t count, const std::array<Lanes, kVectors>& t) {
  std::array<std::array<Lanes, kSeries>, kVectors> sums{};
  if (kind == Terms::powers) {  // Horner
    for (std::size_t m = count; m-- > 0;) {
      const double* term = terms + kStride * m;
#pragma GCC unroll 12
      for (int k = 0; k < kSeries; ++k) {
#pragma GCC unroll 2
        for (std::size_t i = 0; i < kVectors; ++i) sums[i][k] = sums[i][k] * t[i] + term[k];
      }
    }
    return sums;
  }
  // The polynomials stand once for all series; Clenshaw's sum would take two operations for each.
  std::array<Lanes, kVectors> before = t, now;
  now.fill(Lanes{} + 1.0);
  for (std::size_t m = 0; m < count; ++m) {
    const double* term = terms + kStride * m;
#pragma GCC unroll 2
    for (std::size_t i = 0; i < kVectors; ++i) {
#pragma GCC unroll 12
      for (int k = 0; k < kSeries; ++k) sums[i][k] += term[k] * now[i];
      const Lanes next = 2.0 * t[i] * now[i] - before[i];
      before[i] = now[i];
      now[i] = next;
    }
  }
  return sums;
}

/// The same at one t.
template <int kSeries, int kStride>
[[gnu::always_inline]] inline std::array<Lanes, kSeries> sum_series(Terms kind, const double* terms,
                                                                    std::size_t count,
                                                                    const Lanes& t) {
  return sum_series<kSeries, kStride>(kind, terms, count, std::array{t})[0];
}

}  // namespace millstudy::force
