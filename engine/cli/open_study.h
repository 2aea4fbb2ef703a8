// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"
#include "study/study.h"

namespace millstudy::cli {

/// A study file with its overrides, read and checked.
struct OpenStudy {
  study::Study study;
  std::string text;  ///< of the file, as it is
  std::string hash;  ///< SHA-256 of the resolved study
};

/// @throws core::InputError with every fault
OpenStudy open_study(const StudyOptions& options);

/// Tells stderr what the study does at the user's own risk, and what was made of its files.
void print_warnings(const study::Study& study);

}  // namespace millstudy::cli
