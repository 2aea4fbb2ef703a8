// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "io/trace_file.h"
#include "io/traces/source.h"

namespace millstudy::io {

/// Runs a reader in a process of its own and returns what it read.
///
/// For formats that a library of others reads: within a minute of random changes to a small file
/// HDF5 1.10.8 read outside of its memory, and matio 1.5.23 asked for 300 GB; both can compute for
/// long. The process has limits of memory and time; when it fails, the file is refused and the
/// program goes on. With it HDF5 is read at 300 MB/s (bench_trace_file).
///
/// @throws core::InputError as read() does, and where the reader crashes or exceeds a limit
TraceFile read_contained(const Source& source, const std::function<TraceFile()>& read);

}  // namespace millstudy::io
