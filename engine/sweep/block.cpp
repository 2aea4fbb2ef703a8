// SPDX-License-Identifier: MIT
#include "sweep/block.h"

#include <limits>
#include <stdexcept>

namespace millstudy::sweep {

Block::Block(std::int64_t first_point, std::int64_t point_count, std::size_t column_count,
             bool with_traces)
    : first(first_point),
      count(point_count),
      values(column_count * static_cast<std::size_t>(point_count),
             std::numeric_limits<double>::quiet_NaN()),
      status(point_count, Status::not_run),
      failures(point_count),
      traces(with_traces ? point_count : 0) {}

void Sink::leave_out(std::int64_t /*first*/, std::int64_t count) {
  if (count > 0) throw std::logic_error("this sink needs all points");
}

}  // namespace millstudy::sweep
