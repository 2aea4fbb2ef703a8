// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "io/trace_file.h"
#include "io/traces/source.h"

namespace millstudy::io {

/// Runs a reader in a process of its own and returns what it read.
///
/// For formats that a library of others reads: a damaged file made HDF5 1.10.8 write outside of its
/// memory within a minute of random changes to a small file, and matio 1.5.23 ask for as much
/// memory as the file says, or compute for minutes. The process has limits of memory and time; when
/// it fails, the file is refused and the program goes on. Handing the samples over costs about
/// 1 ns a byte.
///
/// @throws core::InputError as read() does, and where the reader crashes or exceeds a limit
TraceFile read_contained(const Source& source, const std::function<TraceFile()>& read);

}  // namespace millstudy::io
