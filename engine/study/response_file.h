// SPDX-License-Identifier: MIT
#pragma once

#include "core/value.h"
#include "study/setting.h"

namespace millstudy::study {

/// The frequency response that a table describes: points = [[Hz, real, imaginary], ...] and unit =
/// "m/N", "mm/N" or "um/N", besides name, source, units, licence and description for people; and
/// the modes fitted to it.
///
/// @throws core::InputError with every fault: unknown keys, wrong types, a unit that is none of
/// displacement over force, and what dynamics::faults() finds in the numbers
ResponsePtr read_response(const core::Value& table);

}  // namespace millstudy::study
