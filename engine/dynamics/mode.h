// SPDX-License-Identifier: MIT
#pragma once

namespace millstudy::dynamics {

/// One mode of vibration of a tool, a workpiece or a dynamometer.
struct Mode {
  double natural_frequency = 0.0;  ///< undamped [rad/s], > 0
  double damping_ratio = 0.0;      ///< of critical damping [1], 0 <= zeta < 1
};

/// Throws core::InputError for a frequency or a damping ratio out of range.
void check(const Mode& mode);

}  // namespace millstudy::dynamics
