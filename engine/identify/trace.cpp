// SPDX-License-Identifier: MIT
#include "identify/trace.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"

namespace millstudy::identify {

std::size_t Trace::size() const {
  std::size_t most = 0;
  for (const std::vector<double>& axis : force) most = std::max(most, axis.size());
  return most;
}

void check(const Trace& trace) {
  const core::Place place{trace.source, 0};
  if (!(std::isfinite(trace.sampling_rate) && trace.sampling_rate > 0.0)) {
    throw core::InputError(place,
                           fmt::format("sampling rate = {} Hz must be > 0", trace.sampling_rate));
  }
  if (trace.size() == 0) throw core::InputError(place, "no axis has a sample");
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& force = trace.force[axis];
    if (!force.empty() && force.size() != trace.size()) {
      throw core::InputError(place, fmt::format("axis {} has {} samples, another has {}",
                                                kAxisNames[axis], force.size(), trace.size()));
    }
    const auto bad =
        std::find_if(force.begin(), force.end(), [](double f) { return !std::isfinite(f); });
    if (bad != force.end()) {
      throw core::InputError(place, fmt::format("axis {}, sample {}: {} is not a force",
                                                kAxisNames[axis], bad - force.begin(), *bad));
    }
  }
}

}  // namespace millstudy::identify
