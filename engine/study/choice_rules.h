// SPDX-License-Identifier: MIT
#pragma once

#include "study/kind.h"

namespace millstudy::study {

/// True if the study must give the key: always, or for what a choice is at one of its points.
bool is_needed(const Key& key, const Kind& kind, const Given& given);

/// A fault for every given key that is of no use with what a choice is, at every point.
void check_uses(const Kind& kind, const Given& given, Faults& faults);

}  // namespace millstudy::study
