// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "cutter/cutter.h"
#include "force/coefficients.h"
#include "force/engagement.h"

namespace millstudy::force {

/// Forces on the tool at successive spindle angles, one array a component.
struct ForceSamples {
  std::vector<double> x;       ///< [N]
  std::vector<double> y;       ///< [N]
  std::vector<double> z;       ///< [N]
  std::vector<double> torque;  ///< [N mm]

  void resize(std::size_t count);
};

/// Force at uniformly spaced spindle angles, geometry prepared once and shared by every feed,
/// every feed direction and every coefficient set.
///
/// Immutable after construction, so one sampler serves any number of threads. A sample has the
/// same bits however the range it is part of was cut. Agrees with force_basis() to 3e-14 of the
/// peak (ball: 6e-14), plus what rounding the angle does where a tooth enters within less than
/// that; a test measures it.
class ForceSampler {
 public:
  /// @param angular_steps  S, samples a revolution, 1 .. 1e7
  /// Throws core::InputError for a cutter, engagement, rule or angular_steps out of range.
  ForceSampler(const cutter::Cutter& cutter, const Engagement& engagement,
               const EdgeRule& edge_rule, int angular_steps);

  /// Forces at the spindle angles 2 pi (first + i) / S, i < count, while the feed frame is turned:
  /// immersion angle = spindle angle + feed_direction; the result is in machine axes.
  ///
  /// @param feed_per_tooth  [mm], >= 0
  /// @param feed_direction  theta, counter-clockwise from machine x [rad], any
  /// @param first           may run on over revolutions without losing digits; negative is allowed
  /// @param count           >= 0
  /// @param out             overwritten from 0; its arrays grow to count + 8 but never shrink, so
  ///                        that one buffer serves many calls; what is beyond count is of no use
  void sample(const Coefficients& coefficients, double feed_per_tooth, double feed_direction,
              std::int64_t first, std::int64_t count, ForceSamples& out) const;

  int angular_steps() const { return angular_steps_; }

 private:
  struct Geometry;
  int angular_steps_;
  std::shared_ptr<const Geometry> geometry_;
};

}  // namespace millstudy::force
