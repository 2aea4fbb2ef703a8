// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "study/study.h"

namespace millstudy::study {

/// The settings that a file stands for: a curve, or the keys of the section that its key is in.
///
/// @param key    a file key
/// @param value  the file's name as the study gives it
/// @param load   reads a file by that name
/// @throws core::InputError with every fault; those without a line are told at the value's place
std::vector<Assignment> settings_of_file(const Key& key, const core::Value& value, const Kind& kind,
                                         const FileLoader& load);

}  // namespace millstudy::study
