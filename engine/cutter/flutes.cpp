// SPDX-License-Identifier: MIT
#include "cutter/flutes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/units.h"

namespace millstudy::cutter {

std::vector<Flute> flutes(const Cutter& cutter) {
  assert(cutter.pitch_angles.empty() || std::ssize(cutter.pitch_angles) == cutter.flutes);
  assert(cutter.helix_angles.empty() || std::ssize(cutter.helix_angles) == cutter.flutes);
  std::vector<Flute> all(cutter.flutes);
  double listed = 0.0;
  for (int j = 0; j < cutter.flutes; ++j) {
    const bool equal = cutter.pitch_angles.empty();
    all[j].position = equal ? j * pitch_angle(cutter) : listed;
    if (!equal) listed += cutter.pitch_angles[j];
    all[j].helix_tangent =
        std::tan(cutter.helix_angles.empty() ? cutter.helix_angle : cutter.helix_angles[j]);
  }
  return all;
}

bool has_equal_flutes(const Cutter& cutter) {
  const double pitch = pitch_angle(cutter);
  return !has_variable_helix(cutter) &&
         std::all_of(cutter.pitch_angles.begin(), cutter.pitch_angles.end(),
                     [&](double angle) { return std::abs(angle - pitch) < 4e-16 * pitch; });
}

bool has_variable_helix(const Cutter& cutter) {
  return std::any_of(cutter.helix_angles.begin(), cutter.helix_angles.end(),
                     [&](double angle) { return angle != cutter.helix_angles.front(); });
}

bool has_runout(const Cutter& cutter) {
  return cutter.runout.offset != 0.0 || cutter.runout.tilt != 0.0;
}

double runout_at(const Runout& runout, double position, double z) {
  const double parallel = runout.offset * std::cos(position - runout.angle);
  if (runout.tilt == 0.0) return parallel;
  return parallel + z * std::tan(runout.tilt) * std::cos(position - runout.tilt_angle);
}

}  // namespace millstudy::cutter
