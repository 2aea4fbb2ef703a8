// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "io/trace_file.h"
#include "io/traces/source.h"

namespace millstudy::io {

/// One format of trace files. Functions throw core::InputError.
struct TraceFormat {
  const char* name;
  /// By the first bytes; cheap.
  bool (*recognise)(std::string_view bytes);
  TraceFile (*read)(const Source& source, const TraceSelection& selection);
  std::vector<std::string> (*variables)(const Source& source);
};

extern const TraceFormat kTdms;      ///< tdms.cpp
extern const TraceFormat kMatlab5;   ///< matlab.cpp
extern const TraceFormat kHdf5;      ///< hdf5_trace.cpp; MATLAB 7.3 files too
extern const TraceFormat kLabview;   ///< labview.cpp
extern const TraceFormat kDynoware;  ///< dynoware.cpp
extern const TraceFormat kTable;     ///< plain_table.cpp: any other text that holds numbers

/// In the order in which they are tried. To add a format: one file, one line here and above.
std::span<const TraceFormat* const> trace_formats();

/// The format of a file.
/// @throws core::InputError that says what the file is, if it can be told, and what can be read
const TraceFormat& recognise_trace_format(const Source& source);

/// Reads bytes that are in memory; path is for messages, except for MATLAB files.
TraceFile read_trace(const Source& source, const TraceSelection& selection);

}  // namespace millstudy::io
