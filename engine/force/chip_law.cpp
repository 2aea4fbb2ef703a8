// SPDX-License-Identifier: MIT
#include "force/chip_law.h"

#include <cmath>

#include "core/units.h"

namespace millstudy::force {

RadialRunout::RadialRunout(const cutter::Runout& runout, double position) {
  cutter::Runout tilt = runout;
  tilt.offset = 0.0;
  const double quarter_behind = position - 0.25 * core::kTurn;
  at_tip = {cutter::runout_at(runout, position, 0.0),
            cutter::runout_at(runout, quarter_behind, 0.0)};
  per_height = {cutter::runout_at(tilt, position, 1.0),
                cutter::runout_at(tilt, quarter_behind, 1.0)};
}

ChipLaw::ChipLaw(const CuttingEdges& edges) : edges_(edges) {
  if (!cutter::has_runout(edges.cutter())) return;
  for (const cutter::Flute& flute : edges.flutes()) {
    runout_.emplace_back(edges.cutter().runout, flute.position);
  }
}

void ChipLaw::find(int flute, const EdgePoint& point, std::span<Reach> out) const {
  if (runout_.empty()) {
    out[0] = {edges_.pitch_ratio(flute, point.lag), 0.0};
    return;
  }
  const std::vector<cutter::Flute>& flutes = edges_.flutes();
  const auto count = static_cast<int>(flutes.size());
  const double radius = runout_[flute].at(point.z, point.direction);
  const double own = flutes[flute].helix_tangent;
  // Mostly there are two helix angles, by turns.
  double tangent = own;
  std::array<double, 2> lag = point.direction;
  for (int m = 1; m < count; ++m) {
    const int other = flute + m < count ? flute + m : flute + m - count;
    const double its = flutes[other].helix_tangent;
    if (its != own && its != tangent) {
      tangent = its;
      lag = {std::cos(tangent * point.lag), std::sin(tangent * point.lag)};
    }
    out[m - 1] = {edges_.pitch_ratio(flute, point.lag, m),
                  radius - runout_[other].at(point.z, its == own ? point.direction : lag)};
  }
  out[count - 1] = {static_cast<double>(count), 0.0};
}

std::vector<ChipLaw::ReachAlong> ChipLaw::along(int flute) const {
  const int count = reaches();
  const RadialRunout& own = runout_[flute];
  std::vector<ReachAlong> all;
  for (int m = 1; m < count; ++m) {
    const RadialRunout& other = runout_[(flute + m) % count];
    all.push_back(
        {edges_.pitch_ratio(flute, 0.0, m),
         {own.at_tip[0] - other.at_tip[0], own.at_tip[1] - other.at_tip[1]},
         {own.per_height[0] - other.per_height[0], own.per_height[1] - other.per_height[1]}});
  }
  all.push_back({static_cast<double>(count), {}, {}});
  return all;
}

}  // namespace millstudy::force
