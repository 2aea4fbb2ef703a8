// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "force/coefficients.h"
#include "force/edge.h"

namespace millstudy::force {

/// What one of the teeth before has left, seen from a point of a flute: it passed so much feed
/// earlier and reached so much further out.
struct Reach {
  double ratio;  ///< feed since it passed, over the mean feed per tooth [1]
  double ahead;  ///< radius of this flute less radius of that one [mm]
};

/// (C14) of one flute, at the tip and for every mm above it: at no lag and at a quarter turn.
struct RadialRunout {
  /// @param position  of the flute [rad]
  RadialRunout(const cutter::Runout& runout, double position);

  /// @param lag  cosine and sine of the lag angle
  double at(double z, const std::array<double, 2>& lag) const {
    return lag[0] * (at_tip[0] + z * per_height[0]) + lag[1] * (at_tip[1] + z * per_height[1]);
  }

  std::array<double, 2> at_tip;      ///< [mm]
  std::array<double, 2> per_height;  ///< [mm/mm]
};

/// (F22): the chip that a tooth finds, whatever the teeth before it left.
class ChipLaw {
 public:
  explicit ChipLaw(const CuttingEdges& edges);

  /// How many teeth before have to be looked at: all of them with runout, else the last one.
  int reaches() const { return runout_.empty() ? 1 : static_cast<int>(runout_.size()); }

  /// The reaches of flute j at a point of its edge: of flute j + 1, j + 2, ..., itself a turn ago.
  ///
  /// @param point  of flute j
  /// @param out    shape (reaches())
  void find(int flute, const EdgePoint& point, std::span<Reach> out) const;

  /// One reach along an edge, of flutes of one helix angle: `ahead` is cos(psi) (at_tip[0] + z
  /// per_height[0]) + sin(psi) (at_tip[1] + z per_height[1]), psi the lag angle.
  struct ReachAlong {
    double ratio;
    std::array<double, 2> at_tip;      ///< [mm]
    std::array<double, 2> per_height;  ///< [mm/mm]
  };
  /// Those of flute j, as find() gives them; only with runout.
  std::vector<ReachAlong> along(int flute) const;

  /// h [mm] = (reach over the feed) . n, the smallest of all reaches counts, never negative.
  ///
  /// @param sin_phi  of the immersion angle of the point
  static double thickness(std::span<const Reach> reaches, const Feed& feed, double sin_phi,
                          double sin_kappa, double cos_kappa) {
    double h = reach_over(reaches[0], feed, sin_phi, sin_kappa, cos_kappa);
    for (const Reach& reach : reaches.subspan(1)) {
      h = std::min(h, reach_over(reach, feed, sin_phi, sin_kappa, cos_kappa));
    }
    return std::max(0.0, h);
  }

  /// (F1): feed vector times normal, plus the difference of the radii [mm]; may be negative.
  static double reach_over(const Reach& reach, const Feed& feed, double sin_phi, double sin_kappa,
                           double cos_kappa) {
    const double advance = feed.in_plane() * sin_phi * sin_kappa - feed.upward() * cos_kappa;
    return reach.ratio * advance + reach.ahead * sin_kappa;
  }

 private:
  const CuttingEdges& edges_;
  std::vector<RadialRunout> runout_;  ///< by flute; empty without
};

}  // namespace millstudy::force
