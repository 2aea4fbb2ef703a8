// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cutter/cutter.h"
#include "force/coefficients.h"
#include "force/edge.h"
#include "force/engagement.h"
#include "force/variation.h"

namespace millstudy::force {

class SamplingRun;

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
/// same bits however the range it is part of was cut. Linear cuts, whose chip is in proportion to
/// the feed, take prepared series and agree with force_basis() to 3e-14 of the peak (series:
/// 1e-13), plus what rounding the angle does where a tooth enters within less than that; a test
/// measures it. Runout, fed in the plane, takes series too, (F25), (F28), (F33), and agrees with
/// NonlinearForce to 4e-12 of the peak. All others are that, sample by sample.
class ForceSampler {
 public:
  /// @param angular_steps  S, samples a revolution, 1 .. 1e7
  /// @param variation      how the coefficients vary along the edge and with the chip
  /// @param with_moments   sample_moments() is going to be used
  /// Throws core::InputError for a cutter, engagement, rule or angular_steps out of range.
  ForceSampler(const cutter::Cutter& cutter, const Engagement& engagement,
               const EdgeRule& edge_rule, int angular_steps, const Variation& variation = {},
               bool with_moments = false);

  /// The same cutter and depth in other arcs, none of which overlap; cheap, for the geometry is
  /// shared. No arc at all is air.
  /// Throws core::InputError for an arc out of range.
  ForceSampler with_arcs(std::span<const Arc> arcs) const;

  /// Forces at the spindle angles 2 pi (first + i) / S, i < count, while the feed frame is turned:
  /// immersion angle = spindle angle + feed direction; the result is in machine axes.
  ///
  /// @param first  may run on over revolutions without losing digits; negative is allowed
  /// @param count  >= 0
  /// @param out    overwritten from 0; its arrays grow to at most count + 8 but never shrink, so
  ///               that one buffer serves many calls; what is beyond count is of no use
  void sample(const Coefficients& coefficients, const Feed& feed, std::int64_t first,
              std::int64_t count, ForceSamples& out) const;

  /// The same of one flute alone, 0 <= flute < N.
  void sample_flute(int flute, const Coefficients& coefficients, const Feed& feed,
                    std::int64_t first, std::int64_t count, ForceSamples& out) const;

  /// (F20): moments of the force about the axes x and y through the tip, in the arrays of these
  /// names [N mm]; the others are zero. Only of a sampler made with_moments.
  void sample_moments(const Coefficients& coefficients, const Feed& feed, std::int64_t first,
                      std::int64_t count, ForceSamples& out) const;

  /// True if samples of this feed are in proportion to it, and so take the prepared series.
  bool is_linear(const Feed& feed) const;

  int angular_steps() const;
  std::span<const Arc> arcs() const;
  const CuttingEdges& edges() const;

 private:
  ForceSampler() = default;
  struct Geometry;
  struct Engaged;
  void add_to(SamplingRun& run, int flute, const Coefficients& coefficients,
              const Feed& feed) const;
  void sample_prepared(int flute, const Coefficients& coefficients, const Feed& feed,
                       std::int64_t first, std::int64_t count, ForceSamples& out) const;
  void sample_nonlinear(int flute, const Coefficients& coefficients, const Feed& feed,
                        std::int64_t first, std::int64_t count, ForceSamples& out) const;

  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const Engaged> engaged_;
  std::shared_ptr<const ForceSampler> moments_;  ///< the same cut with Rows::moments, or null
};

}  // namespace millstudy::force
