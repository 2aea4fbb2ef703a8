// SPDX-License-Identifier: MIT
#pragma once

#include "study/study.h"

namespace millstudy::study {

/// Reads what a swept file stands for: the settings that its contents set.
using FileSettings = std::function<std::vector<Assignment>(const Key&, const core::Value& path)>;

/// Reads [sweep]: design, axes in the order of the file, limits. Faults are collected; what can be
/// read is put into the study, and each axis is entered into given.
void read_sweep(const core::Value& section, const FileSettings& read_file, Study& study,
                Given& given, Faults& faults);

}  // namespace millstudy::study
