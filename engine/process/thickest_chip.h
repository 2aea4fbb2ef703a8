// SPDX-License-Identifier: MIT
#pragma once

#include "cutter/cutter.h"
#include "cutter/envelope.h"
#include "force/coefficients.h"
#include "process/arc_set.h"

namespace millstudy::process {

/// The thickest chip over a path, whose arcs and feed vary.
///
/// Level feed is (F16); on a slope (M11), the same with the upward part of the feed. Exact to
/// rounding. Of a cutter with runout it is the chip without it, as (F16).
class ThickestChip {
 public:
  ThickestChip(const cutter::Cutter& cutter, double axial_depth);

  void take(const ArcSet& arcs, const force::Feed& feed);
  double thickness() const;  ///< [mm], >= 0

 private:
  double on_slope(double steepest, const force::Feed& feed) const;

  cutter::Cutter cutter_;
  cutter::Envelope envelope_;
  double axial_depth_;
  // The level period whose chip is the thickest.
  double level_ = 0.0;  ///< feed per tooth times sin(phi) [mm]
  double level_feed_ = 0.0;
  force::Arc level_arc_;
  double on_slopes_ = 0.0;
};

}  // namespace millstudy::process
