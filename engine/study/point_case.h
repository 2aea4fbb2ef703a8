// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "study/study.h"

namespace millstudy::study {

/// The case of one point after another; keeps a reference to the study.
class PointCase {
 public:
  explicit PointCase(const Study& study)
      : study_(study), indices_(study.axes.size()), case_(study.base) {}

  /// Good until the next call.
  const Case& at(std::int64_t point);

 private:
  const Study& study_;
  std::vector<std::int64_t> indices_;
  Case case_;  // every point sets the same keys
};

/// Inside every limit. One whose quantity cannot be computed is passed: the point then fails with
/// the reason, unless another limit leaves it out.
bool within_limits(const Study& study, const Case& point);

}  // namespace millstudy::study
