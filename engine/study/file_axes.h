// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "study/study.h"

namespace millstudy::study {

/// True if the study gives the key in its own section: then no file decides it.
using IsOwn = std::function<bool(const Key&)>;

/// @throws core::InputError if the study itself gives every key of the file: then reading it would
/// change nothing
void check_not_idle(const Key& file, const std::vector<Assignment>& settings, const IsOwn& is_own,
                    const core::Place& place);

/// Makes the files of an axis set the same keys, or what one of them sets would stay for the points
/// of the next: a key that only some give has its default for the others. What the study gives
/// itself, or sweeps, they do not set.
void settle_file_axes(Study& study, Given& given, const IsOwn& is_own, Faults& faults);

}  // namespace millstudy::study
