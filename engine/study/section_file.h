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

/// Turns lists of tables ([[modes.x]]) into tables of tables ([modes.x.0]), which is what keys are
/// called. Throws core::InputError for a list with something else in it or too long.
void number_lists(core::Value& table, const std::string& prefix, const Kind& kind);

}  // namespace millstudy::study
