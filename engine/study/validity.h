// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "study/study.h"

namespace millstudy::study {

/// A warning for every quantity that leaves the range for which the coefficients hold, at a point
/// within the limits of the study. Of a large study a spread of points is looked at, the corners of
/// the grid among them.
std::vector<core::Fault> left_validity(const Study& study, const Given& given);

}  // namespace millstudy::study
