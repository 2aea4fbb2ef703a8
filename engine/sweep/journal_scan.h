// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sweep/journal.h"

namespace millstudy::sweep {

/// What an open journal holds: every whole frame, also behind damaged ones.
/// @param path  for messages
/// @throws core::InputError if it is no journal, of another version, or its header is damaged
JournalContents scan_journal(int fd, const std::string& path);

}  // namespace millstudy::sweep
