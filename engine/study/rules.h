// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/kind.h"

namespace millstudy::study {

/// A rule between values that a case breaks.
struct BrokenRule {
  std::string_view key;                       ///< whose value it is about
  std::string text;                           ///< the same for every point that breaks it
  std::string detail = {};                    ///< the values of this one, or empty
  std::vector<std::string_view> others = {};  ///< keys that it depends on, too
};

std::vector<BrokenRule> broken_cutter_rules(const Case& point);
std::vector<BrokenRule> broken_coefficient_rules(const Case& point);

/// Faults at the places of the keys; where one that counts is swept, the points judge.
void add_broken(const std::vector<BrokenRule>& broken, const Given& given, Faults& faults);

/// @throws core::CaseError for the first broken rule of the cutter, and for a geometry that does
/// not join
void check_point_cutter(const Case& point);
/// @throws core::CaseError for the first broken rule of the coefficients
void check_point_coefficients(const Case& point);

}  // namespace millstudy::study
