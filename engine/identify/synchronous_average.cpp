// SPDX-License-Identifier: MIT
#include "identify/synchronous_average.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace millstudy::identify {

Trace synchronous_average(const Trace& trace, double spindle_speed) {
  const double per_turn = core::kTurn / spindle_speed * trace.sampling_rate;
  const int bins = std::clamp(static_cast<int>(per_turn), 24, 360);
  const double middle = 0.5 * static_cast<double>(trace.size() - 1);
  std::vector<double> counts(bins, 0.0);
  std::vector<int> bin_of(trace.size());
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const double turns = (static_cast<double>(i) - middle) / per_turn;
    bin_of[i] = std::min(bins - 1, static_cast<int>((turns - std::floor(turns)) * bins));
    counts[bin_of[i]] += 1.0;
  }
  Trace mean{trace.source, spindle_speed * bins / core::kTurn, 0.0, {}};
  for (int axis = 0; axis < 3; ++axis) {
    if (!trace.has_axis(axis)) continue;
    std::vector<double>& force = mean.force[axis];
    force.assign(bins, 0.0);
    for (std::size_t i = 0; i < trace.size(); ++i) force[bin_of[i]] += trace.force[axis][i];
    for (int b = 0; b < bins; ++b) {
      if (counts[b] > 0.0) force[b] /= counts[b];
    }
    for (int b = 0; b < bins; ++b) {
      if (counts[b] > 0.0) continue;
      int before = 1, after = 1;
      while (before < bins && counts[(b - before + bins) % bins] == 0.0) ++before;
      while (after < bins && counts[(b + after) % bins] == 0.0) ++after;
      const double low = force[(b - before + bins) % bins], high = force[(b + after) % bins];
      force[b] = (low * after + high * before) / (before + after);
    }
  }
  return mean;
}

}  // namespace millstudy::identify
