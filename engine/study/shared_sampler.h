// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/error.h"
#include "core/shared_cache.h"
#include "force/sampler.h"
#include "study/rules.h"
#include "study/share_key.h"

namespace millstudy::study {

/// The force geometry of a run: one sampler serves every point that differs only in feed, speed
/// or the values of coefficients.
class SharedSamplers {
 public:
  std::shared_ptr<const force::ForceSampler> get(const Case& point,
                                                 const force::Engagement& engaged,
                                                 bool with_moments) const {
    if (disc_samples(point) > kMostDiscSamples) {
      throw core::CaseError(kTooManyDiscs);
    }
    const force::Variation law = variation(point);
    const std::initializer_list<double> cut = {engaged.entry_angle, engaged.exit_angle,
                                               engaged.axial_depth, with_moments ? 1.0 : 0.0};
    // The law of the coefficients is in the geometry, their values are not.
    std::string key = share_key({cutter_keys(), numerics_keys()}, point, cut);
    if (law.with_chip() || law.with_height()) {
      Case alike = point;
      alike.coefficients = {};
      alike.law.cutting_scale = alike.law.edge_scale = 1.0;
      key += share_key({coefficient_keys()}, alike, {});
    }
    return cache_->get(key, [&] {
      check_point_cutter(point);
      return force::ForceSampler(point.cutter, engaged, point.edge_rule, point.angular_steps, law,
                                 with_moments);
    });
  }

 private:
  static constexpr std::size_t kMostSamplers = 256;
  std::shared_ptr<core::SharedCache<force::ForceSampler>> cache_ =
      std::make_shared<core::SharedCache<force::ForceSampler>>(kMostSamplers);
};

}  // namespace millstudy::study
