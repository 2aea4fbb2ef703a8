// SPDX-License-Identifier: MIT
#include "process/thickest_chip.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "force/statistics.h"

namespace millstudy::process {

ThickestChip::ThickestChip(const cutter::Cutter& cutter, double axial_depth)
    : cutter_(cutter), envelope_(cutter), axial_depth_(axial_depth) {}

void ThickestChip::take(const ArcSet& arcs, const force::Feed& feed) {
  for (const force::Arc& arc : arcs.arcs()) {
    const double steepest = std::clamp(0.5 * core::kPi, arc.entry_angle, arc.exit_angle);
    if (feed.slope != 0.0) {
      on_slopes_ = std::max(on_slopes_, on_slope(steepest, feed));
    } else if (feed.per_tooth * std::sin(steepest) > level_) {
      level_ = feed.per_tooth * std::sin(steepest);
      level_feed_ = feed.per_tooth;
      level_arc_ = arc;
    }
  }
}

double ThickestChip::thickness() const {
  const force::Engagement engagement{level_arc_.entry_angle, level_arc_.exit_angle, axial_depth_};
  return std::max(on_slopes_, force::largest_chip_thickness(cutter_, engagement, level_feed_));
}

double ThickestChip::on_slope(double steepest, const force::Feed& feed) const {
  const double outward = feed.in_plane() * std::sin(steepest);
  const double best_kappa = std::atan2(outward, -feed.upward());
  double thickest = 0.0;
  for (const cutter::Segment& segment : envelope_.segments()) {
    if (segment.bottom >= axial_depth_) break;
    const double low = segment.kappa_at(segment.bottom);
    const double high = segment.kappa_at(std::min(segment.top, axial_depth_));
    const double kappa = std::clamp(best_kappa, std::min(low, high), std::max(low, high));
    thickest = std::max(thickest,
                        outward * std::sin(kappa) - feed.upward() * std::cos(kappa));  // (M11)
  }
  return thickest;
}

}  // namespace millstudy::process
