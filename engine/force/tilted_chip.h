// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <complex>

#include "force/lanes_math.h"
#include "force/prepared_edges.h"
#include "force/runout_stretch.h"

/// The chip of a tooth whose axis is tilted against the spindle's, (F28), a vector of spindle
/// angles at a time.
namespace millstudy::force {

/// A point of a piece.
struct Point {
  Lanes part;         ///< of the piece's lag that is below it, 0 .. 1
  Lanes height;       ///< above the middle of the piece [mm]
  SineAndCosine phi;  ///< of the immersion angle
};

template <class Mask>
[[gnu::always_inline]] inline Point select(const Mask& mask, const Point& a, const Point& b) {
  return {mask ? a.part : b.part,
          mask ? a.height : b.height,
          {mask ? a.phi.sine : b.phi.sine, mask ? a.phi.cosine : b.phi.cosine}};
}

/// The chip of one reach over sin(kappa): its factors of cos(phi) and sin(phi) grow with height.
struct TiltedChip {
  ChipLanes middle;      ///< at the middle of the piece
  ChipLanes per_height;  ///< [1/mm]

  ChipLanes at_height(const Lanes& u) const {
    return {middle.p + u * per_height.p, middle.q + u * per_height.q};
  }
  Lanes at(const Point& point) const { return at_height(point.height).at(point.phi); }

  TiltedChip operator-(const TiltedChip& other) const {
    return {{middle.p - other.middle.p, middle.q - other.middle.q},
            {per_height.p - other.per_height.p, per_height.q - other.per_height.q}};
  }
};

[[gnu::always_inline]] inline TiltedChip operator*(const TiltedChip& chip, const Lanes& factor) {
  return {{chip.middle.p * factor, chip.middle.q * factor},
          {chip.per_height.p * factor, chip.per_height.q * factor}};
}

template <class Mask>
[[gnu::always_inline]] inline TiltedChip select(const Mask& mask, const TiltedChip& a,
                                                const TiltedChip& b) {
  return {select(mask, a.middle, b.middle), select(mask, a.per_height, b.per_height)};
}

/// Of the teeth before.
using TiltedChips = std::array<TiltedChip, RunoutEdge::kMostFlutes>;

/// One reach over the tip angle tau of a tooth: P + i Q = turning exp(i tau) + i feed at the middle
/// of a piece.
struct TiltedLineOfTip : LineOfTip {
  std::complex<double> per_height;  ///< of turning
};

}  // namespace millstudy::force
