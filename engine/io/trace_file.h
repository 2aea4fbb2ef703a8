// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "identify/channels.h"

namespace millstudy::io {

/// What to take from a trace file.
struct TraceSelection {
  /// Channel to be (Fx) = what the file calls it: a column of a text file by name or by number from
  /// 1 ("2"), a variable of a MATLAB file ("Fx_R_1", "run.force.x", "data(:,2)"), the path of a
  /// dataset in HDF5 ("trace_force_x", "/run/data[:,1]"), "group/channel" in TDMS. A channel called
  /// "time" is taken as the time column [s]. Empty: every column or channel, by its own name;
  /// MATLAB and HDF5 files must be asked by name.
  std::map<std::string, std::string> variables = {};
  /// HDF5 results with time histories: the point whose samples are read, counted from 0.
  std::optional<std::int64_t> point = std::nullopt;
  /// Part of every channel, by samples: the first one, counted from 0, and how many.
  struct Range {
    std::int64_t first = 0;
    std::int64_t count = 0;
  };
  std::optional<Range> range = std::nullopt;
  /// LabVIEW text files: the segment to read, counted from 1; none: all, one after another.
  std::optional<int> segment = std::nullopt;
};

/// A file of force traces as it was read.
struct TraceFile {
  std::string format;  ///< "DynoWare text", "MATLAB 5", ...
  identify::ChannelSet channels;
};

/// Most values (channels and time column times samples) read from a file: 1.6 GB.
inline constexpr std::size_t kMostTraceValues = 200'000'000;

/// Reads a trace. The format is recognised by its content, never by its name.
///
/// Formats: DynoWare text exports (dot or comma decimals, also comma-comma), LabVIEW .lvm, other
/// tables of numbers, MATLAB 5 and 7.3, HDF5, NI TDMS; see docs/trace_files.md. Numbers are read to
/// the nearest double; 32-bit floats are exact. Only what is selected is kept in memory.
///
/// @throws core::InputError with up to 20 faults, each with its line: an unknown or damaged format,
///         a variable that is not there (naming those that are), text among the numbers, rows of
///         unequal length, more than kMostTraceValues values
TraceFile read_trace_file(const std::string& path, const TraceSelection& selection = {});

/// Names of what a file offers for TraceSelection::variables, in the order of the file.
std::vector<std::string> trace_variables(const std::string& path);

}  // namespace millstudy::io
