// SPDX-License-Identifier: MIT
#include "force/chip_law.h"

#include "core/units.h"

namespace millstudy::force {

void ChipLaw::find(int flute, double z, double lag, std::span<Reach> out) const {
  if (!runout_) {
    out[0] = {edges_.pitch_ratio(flute, lag), 0.0};
    return;
  }
  const std::vector<cutter::Flute>& flutes = edges_.flutes();
  const auto count = static_cast<int>(flutes.size());
  const auto position = [&](int j) { return flutes[j].position - flutes[j].helix_tangent * lag; };
  const cutter::Runout& runout = edges_.cutter().runout;
  const double own = position(flute);
  const double radius = cutter::runout_at(runout, own, z);
  for (int m = 1; m <= count; ++m) {
    const int other = (flute + m) % count;
    if (m == count) {
      out[m - 1] = {static_cast<double>(count), 0.0};
      continue;
    }
    const double turn = flute + m >= count ? core::kTurn : 0.0;
    const double pitch = position(other) + turn - own;
    out[m - 1] = {pitch * count / core::kTurn,
                  radius - cutter::runout_at(runout, position(other), z)};
  }
}

}  // namespace millstudy::force
