// SPDX-License-Identifier: MIT
#include "dynamics/mode.h"

#include <cmath>
#include <fmt/core.h>

#include "core/error.h"

namespace millstudy::dynamics {

void check(const Mode& mode) {
  if (!(std::isfinite(mode.natural_frequency) && mode.natural_frequency > 0.0)) {
    throw core::InputError(
        fmt::format("natural frequency = {} rad/s must be > 0", mode.natural_frequency));
  }
  if (!(mode.damping_ratio >= 0.0 && mode.damping_ratio < 1.0)) {
    throw core::InputError(
        fmt::format("damping ratio = {} must be >= 0 and < 1", mode.damping_ratio));
  }
}

}  // namespace millstudy::dynamics
