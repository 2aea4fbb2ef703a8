// SPDX-License-Identifier: MIT
#include "io/result_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "core/error.h"
#include "io/point_table.h"
#include "io/result_reader.h"

namespace millstudy::io {
namespace {

sweep::Coordinate coordinate(const PointTable& table, const PointColumn& column) {
  sweep::Coordinate c{column.name, column.study_key, column.units, column.long_name, {}};
  const bool grid = column.stride > 0;
  const Cells cells = grid ? column.values : table.read(column, 0, table.points());
  std::visit([&](const auto& values) { c.values = values; }, cells);
  return c;
}

/// Samples of time histories and where those of each point are.
struct Traces {
  hdf5::Handle start;
  hdf5::Handle count;
  std::array<hdf5::Handle, 5> samples;
  Shape length;
};

Traces open_traces(const PointTable& table) {
  Traces traces{table.other("trace_start"), table.other("trace_count"), {}, {}};
  constexpr std::array<const char*, 5> kNames = {"trace_time", "trace_angle", "trace_force_x",
                                                 "trace_force_y", "trace_force_z"};
  for (std::size_t k = 0; k < kNames.size(); ++k) traces.samples[k] = table.other(kNames[k]);
  traces.length = hdf5::shape_of(traces.samples[0].get());
  if (traces.length.size() != 1) throw hdf5::Error("traces have no length");
  return traces;
}

bool has_traces(const PointTable& table) {
  const hdf5::QuietErrors quiet;
  try {
    table.other("trace_start");
    return true;
  } catch (const hdf5::Error&) {
    return false;
  }
}

}  // namespace

struct ResultBlocks::Open {
  explicit Open(const std::string& file) : path(file), table(file) {}

  const PointColumn& column(PointColumn::Kind kind) const {
    for (const PointColumn& c : table.columns()) {
      if (c.kind == kind) return c;
    }
    throw core::InputError({path, 0}, "is no result of a study: it has no status or no failures");
  }

  std::string path;
  PointTable table;
  sweep::Layout layout;
  std::vector<const PointColumn*> values;
  std::optional<Traces> traces;
};

ResultBlocks::ResultBlocks(const std::string& path) {
  const hdf5::QuietErrors quiet;
  try {
    open_ = std::make_unique<Open>(path);
    const PointTable& table = open_->table;
    sweep::Layout& layout = open_->layout;
    layout.dimensions = table.dimensions();
    layout.shape = table.shape();
    for (const PointColumn& column : table.columns()) {
      const bool is_dimension = std::find(layout.dimensions.begin(), layout.dimensions.end(),
                                          column.name) != layout.dimensions.end();
      if (!column.study_key.empty()) {
        layout.coordinates.push_back(coordinate(table, column));
      } else if (column.kind == PointColumn::Kind::number && !is_dimension) {
        layout.columns.push_back({column.name, column.units, column.long_name});
        open_->values.push_back(&column);
      }
    }
    layout.traces = has_traces(table);
    if (layout.traces) open_->traces = open_traces(table);
    const std::optional<ResultSummary> summary = read_result_summary(path);
    for (const auto& [name, value] : summary->attributes) {
      if (name != "Conventions") layout.attributes.emplace_back(name, value);
    }
  } catch (const hdf5::Error& error) {
    throw core::InputError({path, 0}, fmt::format("is no readable result file: {}", error.what()));
  }
}

ResultBlocks::~ResultBlocks() = default;
ResultBlocks::ResultBlocks(ResultBlocks&&) noexcept = default;

const std::string& ResultBlocks::path() const {
  return open_->path;
}

const sweep::Layout& ResultBlocks::layout() const {
  return open_->layout;
}

sweep::Block ResultBlocks::read(std::int64_t first, std::int64_t count) const {
  const hdf5::QuietErrors quiet;
  const Open& open = *open_;
  sweep::Block block(first, count, 0, false);
  try {
    const std::vector<double> status =
        open.table.numbers(open.column(PointColumn::Kind::status), first, count);
    for (std::int64_t i = 0; i < count; ++i) {
      if (!(status[i] >= 0.0 && status[i] <= 3.0))
        throw core::InputError({open.path, 0}, "has an unknown status");
      block.status[i] = static_cast<sweep::Status>(static_cast<std::int8_t>(status[i]));
    }
    const bool any = std::any_of(block.status.begin(), block.status.end(),
                                 [](sweep::Status one) { return one != sweep::Status::not_run; });
    if (!any) return block;
    block.values.resize(open.values.size() * static_cast<std::size_t>(count));
    if (open.traces) block.traces.resize(static_cast<std::size_t>(count));
    for (std::size_t c = 0; c < open.values.size(); ++c) {
      const std::vector<double> numbers = open.table.numbers(*open.values[c], first, count);
      std::copy(numbers.begin(), numbers.end(),
                block.values.begin() + static_cast<std::ptrdiff_t>(c * numbers.size()));
    }
    block.failures = std::get<std::vector<std::string>>(
        open.table.read(open.column(PointColumn::Kind::failure), first, count));
    if (!open.traces) return block;
    const Shape& shape = open.layout.shape;
    std::vector<std::int64_t> start(count), length(count);
    hdf5::read_range(open.traces->start.get(), H5T_NATIVE_INT64, shape, first, count, start.data());
    hdf5::read_range(open.traces->count.get(), H5T_NATIVE_INT64, shape, first, count,
                     length.data());
    for (std::int64_t i = 0; i < count; ++i) {
      sweep::Trace& trace = block.traces[i];
      const std::int64_t samples = open.traces->length[0];
      if (start[i] < 0 || length[i] < 0 || start[i] > samples - length[i]) {
        throw core::InputError({open.path, 0}, "has a damaged table of traces");
      }
      const std::array<std::vector<float>*, 5> channels = {
          &trace.time, &trace.angle, &trace.force_x, &trace.force_y, &trace.force_z};
      for (std::size_t k = 0; k < channels.size(); ++k) {
        channels[k]->resize(static_cast<std::size_t>(length[i]));
        if (length[i] == 0) continue;
        hdf5::read_range(open.traces->samples[k].get(), H5T_NATIVE_FLOAT, open.traces->length,
                         start[i], length[i], channels[k]->data());
      }
    }
  } catch (const hdf5::Error& error) {
    throw core::InputError({open.path, 0}, fmt::format("cannot be read: {}", error.what()));
  }
  return block;
}

}  // namespace millstudy::io
