// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "force/lanes.h"

namespace millstudy::force {

/// The variable t, -1 .. 1, in which a function of a part, 0 .. 1, is a Chebyshev series: in
/// proportion to sqrt(base + part), or to the part itself for a function that has no root.
class SeriesVariable {
 public:
  static SeriesVariable of_root(double base) { return SeriesVariable(base); }
  static SeriesVariable linear() { return SeriesVariable(std::numeric_limits<double>::infinity()); }

  bool is_linear() const { return std::isinf(base_); }

  double part_at(double t) const {
    if (is_linear()) return 0.5 + 0.5 * t;
    const double root = low_ + (0.5 + 0.5 * t) * (high_ - low_);
    return root * root - base_;
  }

  [[gnu::always_inline]] Lanes at_linear(const Lanes& part) const { return 2.0 * part - 1.0; }
  [[gnu::always_inline]] Lanes at_root(const Lanes& part) const {
    return scale_ * (square_root(base_ + part) - low_) - 1.0;
  }
  [[gnu::always_inline]] Lanes at(const Lanes& part) const {
    return is_linear() ? at_linear(part) : at_root(part);
  }

 private:
  explicit SeriesVariable(double base)
      : base_(base),
        low_(std::sqrt(base)),
        high_(std::sqrt(base + 1.0)),
        scale_(2.0 / (high_ - low_)) {}

  double base_;
  double low_;    // of the root, at part 0
  double high_;   // at part 1
  double scale_;  // of t over the root
};

}  // namespace millstudy::force
