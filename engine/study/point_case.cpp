// SPDX-License-Identifier: MIT
#include "study/point_case.h"

#include <algorithm>
#include <cmath>

namespace millstudy::study {
namespace {

bool within(const Limit& limit, const Case& point) {
  const std::optional<double> value = limit.value(point);
  // Bounds are inclusive, for a computed quantity to rounding: 0.2 as 580 / (14500 x 2 / 10)
  // counts.
  constexpr double kRounding = 1e-12;
  if (!value) return false;
  return (!limit.min || *value >= *limit.min - kRounding * std::abs(*limit.min)) &&
         (!limit.max || *value <= *limit.max + kRounding * std::abs(*limit.max));
}

}  // namespace

const Case& PointCase::at(std::int64_t point) {
  study_.space.indices(point, indices_);
  for (std::size_t a = 0; a < study_.axes.size(); ++a) {
    const Axis& axis = study_.axes[a];
    if (axis.numeric()) {
      apply(*axis.key, axis.numbers[indices_[a]], case_);
    } else {
      for (const Assignment& assignment : axis.settings[indices_[a]]) {
        apply(*assignment.key, assignment.setting, case_);
      }
    }
  }
  return case_;
}

bool within_limits(const Study& study, const Case& point) {
  return std::all_of(study.limits.begin(), study.limits.end(), [&](const Limit& limit) {
    try {
      return within(limit, point);
    } catch (const core::CaseError&) {
      return true;
    } catch (const core::InputError&) {
      return true;
    }
  });
}

Case case_at(const Study& study, std::int64_t point) {
  return PointCase(study).at(point);
}

}  // namespace millstudy::study
