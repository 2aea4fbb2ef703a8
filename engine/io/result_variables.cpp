// SPDX-License-Identifier: MIT
#include "io/result_variables.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <numeric>
#include <string>

#include "io/hdf5_text.h"

namespace millstudy::io {
namespace {

using hdf5::Handle;

constexpr int kGzip = 1;  // measured: higher levels buy nothing on results

struct Description {
  std::string units;
  std::string long_name;
};

/// A dimension without values of its own; the title is netCDF's own mark for it.
Handle create_bare_scale(hid_t file, const std::string& name) {
  Handle scale =
      hdf5::create_dataset(file, name, H5T_IEEE_F32BE, {0},
                           {.chunk = {kChunkElements}, .unlimited = true, .allocate = false});
  hdf5::make_scale(scale.get(),
                   fmt::format("This is a netCDF dimension but not a netCDF variable.{:10}", 0));
  return scale;
}

void describe(hid_t dataset, const Description& description) {
  hdf5::write_attribute(dataset, "units", description.units);
  hdf5::write_attribute(dataset, "long_name", description.long_name);
}

/// A part of a study begins and ends within chunks, which have to be unpacked and packed again when
/// it is merged: there they are small.
Shape chunk_shape(const sweep::Layout& layout) {
  constexpr std::int64_t kFewest = 1024;
  if (is_row_major(layout.shape, layout.chunk)) {
    const std::int64_t elements = element_count(layout.chunk);
    if (kFewest / 2 <= elements && elements <= kChunkElements) return layout.chunk;
  }
  if (layout.points_here == 0) return row_major_chunk(layout.shape, kChunkElements);
  return row_major_chunk(
      layout.shape, std::clamp<std::int64_t>(layout.points_here / 16, kFewest, kChunkElements));
}

/// Makes the variables of one file; knows its dimensions.
class Builder {
 public:
  Builder(hid_t file, const sweep::Layout& layout)
      : file_(file), layout_(layout), chunk_(chunk_shape(layout)) {
    if (is_grid()) {
      for (const sweep::Coordinate& coordinate : layout.coordinates) {
        scales_.push_back(create_coordinate(coordinate));
        hdf5::make_scale(scales_.back().get(), coordinate.name);
      }
      return;
    }
    scales_.push_back(create_point_numbers());
    for (const sweep::Coordinate& coordinate : layout.coordinates) {
      const Handle dataset = create_coordinate(coordinate);
      hdf5::attach_scale(dataset.get(), scales_[0].get(), 0);
      if (!auxiliary_.empty()) auxiliary_ += ' ';
      auxiliary_ += coordinate.name;
    }
  }

  template <class T>
  ChunkStream<T> create(const std::string& name, hid_t type, const Description& description,
                        T fill) {
    const hdf5::DatasetOptions options{.chunk = chunk_,
                                       .gzip = kGzip,
                                       .fill = static_cast<double>(fill),
                                       .fill_is_missing = std::is_floating_point_v<T>};
    Handle dataset = hdf5::create_dataset(file_, name, type, layout_.shape, options);
    describe(dataset.get(), description);
    if (!auxiliary_.empty()) hdf5::write_attribute(dataset.get(), "coordinates", auxiliary_);
    for (std::size_t d = 0; d < scales_.size(); ++d) {
      hdf5::attach_scale(dataset.get(), scales_[d].get(), d);
    }
    return {std::move(dataset), layout_.shape, chunk_, fill};
  }

  const Shape& chunk() const { return chunk_; }

 private:
  /// A grid has a dimension for every coordinate; the other designs have one for all.
  bool is_grid() const {
    if (layout_.dimensions.size() != layout_.coordinates.size()) return false;
    for (std::size_t d = 0; d < layout_.dimensions.size(); ++d) {
      if (layout_.dimensions[d] != layout_.coordinates[d].name) return false;
    }
    return true;
  }

  Handle create_coordinate(const sweep::Coordinate& coordinate) {
    Handle dataset;
    if (const auto* texts = std::get_if<std::vector<std::string>>(&coordinate.values)) {
      dataset = hdf5::create_texts(file_, coordinate.name, *texts);
    } else {
      const auto& values = std::get<std::vector<double>>(coordinate.values);
      const Shape shape = {static_cast<std::int64_t>(values.size())};
      dataset = hdf5::create_dataset(file_, coordinate.name, H5T_IEEE_F64LE, shape);
      hdf5::write_range(dataset.get(), H5T_NATIVE_DOUBLE, shape, 0, shape[0], values.data());
    }
    describe(dataset.get(), {coordinate.units, coordinate.long_name});
    hdf5::write_attribute(dataset.get(), "study_key", coordinate.key);
    return dataset;
  }

  Handle create_point_numbers() {
    Handle dataset = hdf5::create_dataset(file_, layout_.dimensions.at(0), H5T_STD_I64LE,
                                          layout_.shape, {.chunk = chunk_, .gzip = kGzip});
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(chunk_[0]));
    for (std::int64_t begin = 0; begin < layout_.shape[0]; begin += chunk_[0]) {
      std::iota(numbers.begin(), numbers.end(), begin);
      hdf5::write_range(dataset.get(), H5T_NATIVE_INT64, layout_.shape, begin,
                        std::min(chunk_[0], layout_.shape[0] - begin), numbers.data());
    }
    hdf5::make_scale(dataset.get(), layout_.dimensions[0]);
    describe(dataset.get(), {"1", "point number"});
    return dataset;
  }

  hid_t file_;
  const sweep::Layout& layout_;
  Shape chunk_;
  std::vector<Handle> scales_;
  std::string auxiliary_;  // names of the coordinates that are no dimension
};

TraceVariables create_traces(hid_t file, Builder& builder) {
  TraceVariables traces{
      builder.create<std::int64_t>("trace_start", H5T_STD_I64LE,
                                   {"1", "first sample of the trace of a point"}, 0),
      builder.create<std::int64_t>("trace_count", H5T_STD_I64LE,
                                   {"1", "number of samples of the trace of a point"}, 0),
      {},
      create_bare_scale(file, "sample")};
  hdf5::write_attribute(traces.count.dataset(), "sample_dimension", std::string("sample"));
  for (const TraceChannel& channel : kTraceChannels) {
    Handle dataset = hdf5::create_dataset(file, channel.name, H5T_IEEE_F32LE, {0},
                                          {.chunk = {kChunkElements},
                                           .unlimited = true,
                                           .gzip = kGzip,
                                           .fill = kMissing,
                                           .fill_is_missing = true});
    describe(dataset.get(), {channel.units, channel.long_name});
    hdf5::attach_scale(dataset.get(), traces.sample_scale.get(), 0);
    traces.samples.emplace_back(std::move(dataset), Shape{0}, Shape{kChunkElements},
                                static_cast<float>(kMissing));
  }
  return traces;
}

}  // namespace

void TraceVariables::append(const sweep::Block& block) {
  for (std::int64_t i = 0; i < block.count; ++i) {
    const sweep::Trace& trace = block.traces.at(static_cast<std::size_t>(i));
    const bool ok = block.status[static_cast<std::size_t>(i)] == sweep::Status::ok;
    const auto length = ok ? static_cast<std::int64_t>(trace.time.size()) : 0;
    const bool is_here = block.status[static_cast<std::size_t>(i)] != sweep::Status::not_run;
    const std::int64_t first = is_here ? written : 0;  // nothing, and no space, in other parts
    start.append({&first, 1});
    count.append({&length, 1});
    if (!ok) continue;
    for (std::size_t k = 0; k < kTraceChannels.size(); ++k) {
      const std::vector<float>& channel = trace.*kTraceChannels[k].samples;
      if (channel.size() != trace.time.size()) throw std::logic_error("a trace is ragged");
      samples[k].append(channel);
    }
    written += length;
  }
}

void TraceVariables::flush() {
  start.flush();
  count.flush();
  for (ChunkStream<float>& stream : samples) stream.flush();
  hdf5::extend(sample_scale.get(), written);
}

ResultVariables create_variables(hid_t file, const sweep::Layout& layout) {
  Builder builder(file, layout);
  std::vector<ChunkStream<double>> columns;
  for (const sweep::Column& column : layout.columns) {
    columns.push_back(builder.create<double>(column.name, H5T_IEEE_F64LE,
                                             {column.units, column.long_name}, kMissing));
  }
  ResultVariables variables{
      std::move(columns),
      builder.create<std::int8_t>("status", H5T_STD_I8LE, {"1", "what happened to the point"},
                                  static_cast<std::int8_t>(sweep::Status::not_run)),
      builder.create<std::int32_t>("failure_code", H5T_STD_I32LE,
                                   {"1", "index of the reason in failure"}, 0),
      builder.chunk(),
      {}};
  const std::array<std::int8_t, 4> flags = {0, 1, 2, 3};
  hdf5::write_attribute(variables.status.dataset(), "flag_values", flags);
  hdf5::write_attribute(variables.status.dataset(), "flag_meanings",
                        std::string("ok failed skipped not_run"));
  if (layout.traces) variables.traces.push_back(create_traces(file, builder));
  return variables;
}

void write_failures(hid_t file, const std::vector<std::string>& reasons) {
  const Handle table = hdf5::create_texts(file, "failure", reasons);
  hdf5::make_scale(table.get(), "failure");
  describe(table.get(), {"1", "why a point failed, by failure_code"});
}

}  // namespace millstudy::io
