// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "cli/commands.h"
#include "cli/open_study.h"
#include "sweep/crash_record.h"
#include "sweep/journal.h"

/// What a run does with its journal before it computes.
namespace millstudy::cli {

/// What the journal of a run must be of.
sweep::JournalHeader journal_header(const OpenStudy& open, const sweep::Layout& layout,
                                    const RunSettings& settings, std::int64_t block_size);

/// @throws core::InputError for a journal that this run cannot go on with
void check_same(const std::string& path, const sweep::JournalHeader& there,
                const sweep::JournalHeader& wanted);

/// @throws core::InputError if a result is not of this program and instruction set
void check_same_program(const std::string& path);

/// Makes failed points of a journal pending again; of an empty one, with those of a finished
/// result in it.
void reopen_failed(sweep::Journal& journal, const std::string& result);

/// A point that has crashed the program twice is not tried a third time.
void fail_crashed_points(sweep::Journal& journal,
                         const std::map<std::int64_t, sweep::Crashes>& crashes);

}  // namespace millstudy::cli
