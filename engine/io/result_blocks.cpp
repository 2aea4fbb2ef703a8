// SPDX-License-Identifier: MIT
#include "io/result_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <span>

#include "core/error.h"
#include "io/chunk_reader.h"
#include "io/point_table.h"
#include "io/result_reader.h"
#include "io/result_variables.h"

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
  std::array<hdf5::Handle, kTraceChannels.size()> samples;
  Shape length;
};

Traces open_traces(const PointTable& table) {
  Traces traces{table.other("trace_start"), table.other("trace_count"), {}, {}};
  for (std::size_t k = 0; k < kTraceChannels.size(); ++k) {
    traces.samples[k] = table.other(kTraceChannels[k].name);
  }
  traces.length = hdf5::shape_of(traces.samples[0].get());
  if (traces.length.size() != 1) throw hdf5::Error("traces have no length");
  if (hdf5::shape_of(traces.start.get()) != table.shape() ||
      hdf5::shape_of(traces.count.get()) != table.shape()) {
    throw hdf5::Error("traces are not those of the points");
  }
  for (const hdf5::Handle& samples : traces.samples) {
    if (hdf5::shape_of(samples.get()) != traces.length) throw hdf5::Error("traces are ragged");
    constexpr double kMostShrunk = 1100.0;  // by gzip
    const double bytes = kMostShrunk * static_cast<double>(H5Dget_storage_size(samples.get()));
    if (bytes < static_cast<double>(traces.length[0]) * sizeof(float)) {
      throw hdf5::Error("traces are shorter than they claim");
    }
  }
  return traces;
}

/// Traces of the points of a block: those that follow one another in the file are read at once.
void read_traces(const Traces& from, const Shape& shape, sweep::Block& block) {
  const auto points = static_cast<std::size_t>(block.count);
  std::vector<std::int64_t> start(points), length(points);
  const auto read_table = [&](const hdf5::Handle& dataset, std::vector<std::int64_t>& to) {
    hdf5::read_range(dataset.get(), H5T_NATIVE_INT64, shape, block.first, block.count, to.data());
  };
  read_table(from.start, start);
  read_table(from.count, length);
  block.traces.resize(points);
  std::vector<float> samples;
  for (std::size_t begin = 0, end = 0; begin < points; begin = end) {
    std::int64_t last = start[begin];  // of the samples, past the end
    for (; end < points && start[end] == last; ++end) {
      if (start[end] < 0 || length[end] < 0 || length[end] > from.length[0] - start[end]) {
        throw hdf5::Error("the table of traces is damaged");
      }
      last += length[end];
    }
    samples.resize(static_cast<std::size_t>(last - start[begin]));
    if (samples.empty()) continue;
    for (std::size_t k = 0; k < kTraceChannels.size(); ++k) {
      hdf5::read_range(from.samples[k].get(), H5T_NATIVE_FLOAT, from.length, start[begin],
                       last - start[begin], samples.data());
      const float* next = samples.data();
      for (std::size_t i = begin; i < end; ++i) {
        (block.traces[i].*kTraceChannels[k].samples).assign(next, next + length[i]);
        next += length[i];
      }
    }
  }
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
  std::vector<ChunkReader> packed;  ///< of the values, then the status; none if not all are alike
};

namespace {

/// Readers of the chunks of several variables; none if not all of them have chunks of this shape.
std::vector<ChunkReader> chunk_readers(const std::vector<const PointColumn*>& values,
                                       const PointColumn& status, const sweep::Layout& layout) {
  std::vector<ChunkReader> readers;
  const auto add = [&](const PointColumn& column, hid_t memory_type) {
    auto reader = ChunkReader::of(column.dataset.get(), memory_type, layout.shape);
    if (reader && reader->chunk() == layout.chunk) readers.push_back(*std::move(reader));
  };
  for (const PointColumn* const column : values) add(*column, H5T_NATIVE_DOUBLE);
  add(status, H5T_NATIVE_INT8);
  if (readers.size() != values.size() + 1) readers.clear();
  return readers;
}

}  // namespace

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
    layout.chunk = table.chunk();
    if (!layout.traces)
      open_->packed =
          chunk_readers(open_->values, open_->column(PointColumn::Kind::status), layout);
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

std::int64_t ResultBlocks::chunk_end(std::int64_t point) const {
  return chunk_around(open_->layout.shape, open_->layout.chunk, point).end;
}

sweep::Block ResultBlocks::read(std::int64_t first, std::int64_t count) const {
  sweep::Block block(first, count, 0, false);
  read(first, count, block);
  return block;
}

bool ResultBlocks::read_packed(std::int64_t first, std::int64_t end, PackedPoints& points) const {
  const hdf5::QuietErrors quiet;
  const Open& open = *open_;
  if (open.packed.empty()) return false;
  const Run run = open.packed.back().around(first);
  if (run.begin != first || run.end > end) return false;
  points.first = first;
  points.count = run.end - first;
  points.columns.resize(open.values.size());
  try {
    std::vector<double> numbers(static_cast<std::size_t>(points.count));
    open.table.read_numbers(open.column(PointColumn::Kind::status), first, numbers);
    const auto is_ok = [](double code) { return code == static_cast<double>(sweep::Status::ok); };
    if (!std::all_of(numbers.begin(), numbers.end(), is_ok)) return false;
    for (std::size_t c = 0; c < points.columns.size(); ++c) {
      if (open.packed[c].read_packed(first, points.columns[c])) continue;
      // Left out because nobody has a value, or damaged: the library knows, and tells.
      open.table.read_numbers(*open.values[c], first, numbers);
      const auto is_missing = [](double value) { return same_bits(value, kMissing); };
      if (!std::all_of(numbers.begin(), numbers.end(), is_missing)) return false;
      points.columns[c].bytes.clear();
    }
    return open.packed.back().read_packed(first, points.status);
  } catch (const hdf5::Error& error) {
    throw core::InputError({open.path, 0}, fmt::format("cannot be read: {}", error.what()));
  }
}

void ResultBlocks::read(std::int64_t first, std::int64_t count, sweep::Block& block) const {
  const hdf5::QuietErrors quiet;
  const Open& open = *open_;
  const auto points = static_cast<std::size_t>(count);
  block.first = first;
  block.count = count;
  block.status.resize(points);
  block.failures.assign(points, {});
  block.traces.clear();
  try {
    std::vector<double> codes(points);
    open.table.read_numbers(open.column(PointColumn::Kind::status), first, codes);
    for (std::size_t i = 0; i < points; ++i) {
      if (!(codes[i] >= 0.0 && codes[i] <= 3.0))
        throw core::InputError({open.path, 0}, "has an unknown status");
      block.status[i] = static_cast<sweep::Status>(static_cast<std::int8_t>(codes[i]));
    }
    const bool any = std::any_of(block.status.begin(), block.status.end(),
                                 [](sweep::Status one) { return one != sweep::Status::not_run; });
    block.values.resize(any ? open.values.size() * points : 0);
    if (!any) return;
    for (std::size_t c = 0; c < open.values.size(); ++c) {
      open.table.read_numbers(*open.values[c], first,
                              std::span(block.values).subspan(c * points, points));
    }
    open.table.read_numbers(open.column(PointColumn::Kind::failure), first, codes);
    for (std::size_t i = 0; i < points; ++i) {
      if (codes[i] != 0.0) block.failures[i] = open.table.reason(codes[i]);
    }
    if (open.traces) read_traces(*open.traces, open.layout.shape, block);
  } catch (const hdf5::Error& error) {
    throw core::InputError({open.path, 0}, fmt::format("cannot be read: {}", error.what()));
  }
}

}  // namespace millstudy::io
