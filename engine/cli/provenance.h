// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cli/open_study.h"
#include "sweep/layout.h"

namespace millstudy::cli {

/// Attributes that say which program made a result, where and when.
std::vector<sweep::Attribute> provenance(int threads);

/// The same, and which study it is a result of.
std::vector<sweep::Attribute> origin(const OpenStudy& open, const StudyOptions& options,
                                     int threads);

/// "process 123 on host"
std::string this_process();

}  // namespace millstudy::cli
