// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/error.h"
#include "core/shared_cache.h"
#include "force/sampler.h"
#include "study/rows.h"

namespace millstudy::study {

/// The force geometry of a run: one sampler serves every point that differs only in feed, speed
/// or coefficients.
class SharedSamplers {
 public:
  std::shared_ptr<const force::ForceSampler> get(const Case& point,
                                                 const force::Engagement& engaged) const {
    if (disc_samples(point) > kMostDiscSamples) {
      throw core::CaseError("numerics.discs x numerics.angular_steps must be <= 1e+09");
    }
    const std::string key = share_key(
        point.cutter.shape, point.cutter.diameter, point.cutter.flutes, point.cutter.helix_angle,
        engaged.entry_angle, engaged.exit_angle, engaged.axial_depth, point.edge_rule.rule,
        point.edge_rule.discs, point.angular_steps);
    return cache_->get(key, [&] {
      return force::ForceSampler(point.cutter, engaged, point.edge_rule, point.angular_steps);
    });
  }

 private:
  static constexpr std::size_t kMostSamplers = 256;
  std::shared_ptr<core::SharedCache<force::ForceSampler>> cache_ =
      std::make_shared<core::SharedCache<force::ForceSampler>>(kMostSamplers);
};

}  // namespace millstudy::study
