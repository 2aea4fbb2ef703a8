// SPDX-License-Identifier: MIT
#pragma once

#include "core/value.h"
#include "study/setting.h"

namespace millstudy::study {

/// The curve that a table describes: degree, knots, points_mm or points_um, weights (1 where they
/// are not given), besides name, source, units, licence and description for people.
///
/// @throws core::InputError with every fault: unknown keys, wrong types, and what path::faults()
/// finds in the numbers
CurvePtr read_curve(const core::Value& table);

}  // namespace millstudy::study
