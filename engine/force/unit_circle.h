// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

namespace millstudy::force {

/// Cosines and sines of 2 pi n / S: most of the time that a cutter of its own takes at every point
/// of a sweep, were they not shared.
struct UnitCircle {
  std::vector<double> cosine;
  std::vector<double> sine;

  /// At least the first `count`, which may be more than S. A thread has one circle of up to 65,536
  /// steps (1 MB) for all; longer ones are made anew, of no more than what is asked for.
  static std::shared_ptr<const UnitCircle> of(int angular_steps, int count);
};

}  // namespace millstudy::force
