// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sweep/layout.h"

namespace millstudy::sweep {

/// What happened to a point; the values are those of the result file.
enum class Status : std::int8_t { ok = 0, failed = 1, skipped = 2, not_run = 3 };

/// Time history of one point, in single precision to halve the file; all vectors have one length.
struct Trace {
  std::vector<float> time;     ///< [s]
  std::vector<float> angle;    ///< spindle angle, running on over revolutions [rad]
  std::vector<float> force_x;  ///< [N], machine axes
  std::vector<float> force_y;
  std::vector<float> force_z;
};

/// Results of the contiguous points first .. first + count - 1: the unit of scheduling.
struct Block {
  Block(std::int64_t first_point, std::int64_t point_count, std::size_t column_count,
        bool with_traces);

  std::int64_t first;
  std::int64_t count;
  std::vector<double> values;         ///< shape (columns, count), row-major, NaN unless ok
  std::vector<Status> status;         ///< shape (count)
  std::vector<std::string> failures;  ///< reason of each failed point, else empty; shape (count)
  std::vector<Trace> traces;          ///< shape (count), or empty
  double seconds = 0.0;               ///< that its computation took on its thread

  double& value(std::size_t column, std::int64_t i) { return values[column * count + i]; }
  double value(std::size_t column, std::int64_t i) const { return values[column * count + i]; }
};

/// Where blocks go, in order unless the run is told otherwise. A sink that is destroyed before
/// finish() leaves nothing.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void write(const Block& block) = 0;
  /// In place of blocks: these points are of other parts of the study, and nothing is said of them.
  /// Unless a sink says otherwise, it takes no parts: then it may be asked for no points only.
  virtual void leave_out(std::int64_t first, std::int64_t count);
  /// All blocks are in; adds what is known only now (wall time, counts) and makes the result final.
  virtual void finish(const std::vector<Attribute>& attributes) = 0;
};

}  // namespace millstudy::sweep
