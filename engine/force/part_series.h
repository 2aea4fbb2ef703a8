// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "cutter/envelope.h"
#include "force/edge.h"
#include "force/lanes.h"
#include "force/series.h"

namespace millstudy::force {

/// A smooth function of the points of a piece of edge, by the part of its lag that is below them,
/// 0 .. 1: a Chebyshev series.
class PartSeries {
 public:
  /// @param negligible  terms below are dropped: rounding leaves as much in every one
  PartSeries(const std::function<double(double)>& function, double negligible);

  struct At {
    Lanes value;
    Lanes slope;  ///< over the part
  };
  [[gnu::always_inline]] At at(const Lanes& part) const {
    const Lanes t = 2.0 * part - 1.0;
    if (terms_.size() == 2) {  // linear
      return {terms_[0][0] + terms_[1][0] * t, Lanes{} + 2.0 * terms_[0][1]};
    }
    const std::array<Lanes, 2> sums =
        sum_series<2, 2>(Terms::chebyshev, terms_.front().data(), terms_.size(), t);
    return {sums[0], 2.0 * sums[1]};
  }

 private:
  std::vector<std::array<double, 2>> terms_;  ///< of the value and of its slope over 2 part - 1
};

/// The height above the middle of a piece [mm]: two terms where lag goes with height, some ten on a
/// cone of constant helix angle. Right to 1.2e-15 of the height (measured). Its slopes fall or grow
/// all along the piece.
PartSeries height_series(const cutter::Envelope& envelope, const EdgePiece& piece);

}  // namespace millstudy::force
