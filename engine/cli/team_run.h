// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/commands.h"
#include "cli/open_study.h"
#include "sweep/team.h"

/// What the processes of a team that runs a study have in common.
namespace millstudy::cli {

/// The file that a run makes.
std::string result_path(const OpenStudy& open, const RunSettings& settings);
std::string crash_record_path(const std::string& result);

/// Study, program and instruction set: what must be the same for equal digits.
std::string team_identity(const OpenStudy& open);

/// The verb run in every process but the first: computes blocks for that one.
int help_run(sweep::Team& team, const StudyOptions& options, const RunSettings& settings);

}  // namespace millstudy::cli
