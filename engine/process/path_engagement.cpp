// SPDX-License-Identifier: MIT
#include "process/path_engagement.h"

#include "core/units.h"

namespace millstudy::process {

PathEngagement::PathEngagement(const path::Interpolation& path, const Machining& machining)
    : radius_(cutter::radius(machining.cutter)),
      immersion_(machining.immersion),
      straight_(machining.engagement.arc()) {
  if (immersion_.side != Immersion::Side::constant) {
    straight_ = immersed_arc(radius_, immersion_, {});
    // No point of a wall that the tool touches is further ahead, on a circle of any radius.
    bends_ = bends_of(path, core::kPi * radius_);
  }
  if (machining.stock != Stock::endless) ends_.emplace(path, radius_, machining.stock);
}

ArcSet PathEngagement::arcs(std::int64_t i, double feed_direction) const {
  ArcSet arcs = straight_;
  if (!bends_.empty() && bends_[i].curvature != 0.0) {
    arcs = immersed_arc(radius_, immersion_, bends_[i]);
  }
  return ends_ ? ends_->within(arcs, i, feed_direction) : arcs;
}

}  // namespace millstudy::process
