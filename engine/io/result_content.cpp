// SPDX-License-Identifier: MIT
#include "io/result_content.h"

#include <fmt/core.h>
#include <variant>

#include "core/error.h"

namespace millstudy::io {
namespace {

void write_attributes(hid_t file, const std::vector<sweep::Attribute>& attributes) {
  for (const auto& [name, value] : attributes) {
    std::visit([&, &key = name](const auto& v) { hdf5::write_attribute(file, key, v); }, value);
  }
}

hdf5::Handle begin(hdf5::Output& output, const sweep::Layout& layout) {
  if (layout.shape.size() > H5S_MAX_RANK) {
    throw core::InputError(fmt::format("a result file has at most {} dimensions, not {}",
                                       H5S_MAX_RANK, layout.shape.size()));
  }
  hdf5::Handle file = hdf5::create_file(output);
  hdf5::write_attribute(file.get(), "Conventions", std::string("CF-1.8"));
  write_attributes(file.get(), layout.attributes);
  return file;
}

}  // namespace

ResultContent::ResultContent(hdf5::Output& output, const sweep::Layout& layout)
    : file_(begin(output, layout)), variables_(create_variables(file_.get(), layout)) {}

void ResultContent::append(const sweep::Block& block) {
  const auto count = static_cast<std::size_t>(block.count);
  for (std::size_t c = 0; c < variables_.columns.size(); ++c) {
    variables_.columns[c].append({block.values.data() + c * count, count});
  }
  std::vector<std::int8_t> status(count);
  std::vector<std::int32_t> codes(count);
  for (std::size_t i = 0; i < count; ++i) {
    status[i] = static_cast<std::int8_t>(block.status[i]);
    codes[i] = block.failures[i].empty() ? 0 : failures_.code(block.failures[i]);
  }
  variables_.status.append(status);
  variables_.failure_code.append(codes);
  for (TraceVariables& traces : variables_.traces) traces.append(block);
}

void ResultContent::append(const PackedPoints& points) {
  for (std::size_t c = 0; c < variables_.columns.size(); ++c) {
    variables_.columns[c].append_packed(points.columns[c]);
  }
  variables_.status.append_packed(points.status);
  variables_.failure_code.leave_out(points.count);  // there are none
}

void ResultContent::leave_out(std::int64_t count) {
  for (ChunkStream<double>& column : variables_.columns) column.leave_out(count);
  variables_.status.leave_out(count);
  variables_.failure_code.leave_out(count);
  for (TraceVariables& traces : variables_.traces) {
    traces.start.leave_out(count);
    traces.count.leave_out(count);
  }
}

void ResultContent::finish(const std::vector<sweep::Attribute>& attributes) {
  for (ChunkStream<double>& column : variables_.columns) column.flush();
  variables_.status.flush();
  variables_.failure_code.flush();
  for (TraceVariables& traces : variables_.traces) traces.flush();
  write_failures(file_.get(), failures_.reasons());
  write_attributes(file_.get(), attributes);
  hdf5::check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL), "flush the file");
}

}  // namespace millstudy::io
