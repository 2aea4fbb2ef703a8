// SPDX-License-Identifier: MIT
#pragma once

#include "core/value.h"
#include "study/setting.h"

namespace millstudy::study {

/// The profile that a table describes: points_mm = [[z, r], ...] from the tip upwards, besides
/// name, source, units, licence and description for people.
///
/// @throws core::InputError with every fault: unknown keys, wrong types, fewer than 2 or more than
/// 1000 points, a first height that is not 0, heights that do not rise, negative radii
ProfilePtr read_profile(const core::Value& table);

}  // namespace millstudy::study
