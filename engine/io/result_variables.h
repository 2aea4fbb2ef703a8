// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "io/chunk_stream.h"
#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::io {

/// Values in a chunk of a variable, at most.
inline constexpr std::int64_t kChunkElements = 1 << 16;

/// What a result is where there is none: the fill value of its variable.
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// The variables of the samples of time histories.
struct TraceChannel {
  const char* name;
  const char* units;
  const char* long_name;
  std::vector<float> sweep::Trace::*samples;
};
inline constexpr std::array<TraceChannel, 5> kTraceChannels = {{
    {"trace_time", "s", "time", &sweep::Trace::time},
    {"trace_angle", "rad", "spindle angle", &sweep::Trace::angle},
    {"trace_force_x", "N", "force on the tool along x", &sweep::Trace::force_x},
    {"trace_force_y", "N", "force on the tool along y", &sweep::Trace::force_y},
    {"trace_force_z", "N", "force on the tool along z", &sweep::Trace::force_z},
}};

/// Time histories of all points, one after another: CF contiguous ragged arrays.
struct TraceVariables {
  ChunkStream<std::int64_t> start;
  ChunkStream<std::int64_t> count;
  std::vector<ChunkStream<float>> samples;  ///< of kTraceChannels
  hdf5::Handle sample_scale;
  std::int64_t written = 0;  ///< samples

  void append(const sweep::Block& block);
  void flush();
};

/// The variables of a result file that take a value for every point.
struct ResultVariables {
  std::vector<ChunkStream<double>> columns;
  ChunkStream<std::int8_t> status;
  ChunkStream<std::int32_t> failure_code;
  Shape chunk;
  std::vector<TraceVariables> traces;  ///< one, or none
};

/// Makes dimensions, coordinates and empty variables in a new file (docs/result_file.md).
ResultVariables create_variables(hid_t file, const sweep::Layout& layout);

/// Writes the table that failure_code points into, on its own dimension.
void write_failures(hid_t file, const std::vector<std::string>& reasons);

}  // namespace millstudy::io
