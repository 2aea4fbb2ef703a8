// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "cutter/envelope.h"
#include "force/edge.h"
#include "force/lanes.h"
#include "force/series.h"

namespace millstudy::force {

/// The height of the points of a piece above its middle, by the part of its lag that is below them:
/// two terms where lag goes with height, some ten on a cone of constant helix angle. Right
/// to 1.2e-15 of the height (measured).
class HeightSeries {
 public:
  HeightSeries(const cutter::Envelope& envelope, const EdgePiece& piece);

  struct Height {
    Lanes value;  ///< [mm]
    Lanes slope;  ///< over the part [mm]
  };
  [[gnu::always_inline]] Height at(const Lanes& part) const {
    const Lanes t = 2.0 * part - 1.0;
    if (terms_.size() == 2) {  // linear
      return {terms_[0][0] + terms_[1][0] * t, Lanes{} + 2.0 * terms_[0][1]};
    }
    const std::array<Lanes, 2> sums =
        sum_series<2, 2>(Terms::chebyshev, terms_.front().data(), terms_.size(), t);
    return {sums[0], 2.0 * sums[1]};
  }

  /// The largest slope [mm]; slopes fall or grow all along the piece.
  double steepest() const;

 private:
  std::vector<std::array<double, 2>> terms_;  ///< of the height and of its slope over 2 part - 1
};

}  // namespace millstudy::force
