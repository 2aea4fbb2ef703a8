// SPDX-License-Identifier: MIT
#include "io/result_size.h"

#include "io/result_variables.h"
#include "io/row_major.h"

namespace millstudy::io {
namespace {

double attribute_bytes(const sweep::Layout& layout) {
  double bytes = 0.0;
  for (const sweep::Attribute& attribute : layout.attributes) {
    const auto* text = std::get_if<std::string>(&attribute.second);
    bytes += 100.0 + (text ? static_cast<double>(text->size()) : 8.0);
  }
  return bytes;
}

double coordinate_bytes(const sweep::Coordinate& coordinate) {
  const auto* numbers = std::get_if<std::vector<double>>(&coordinate.values);
  if (numbers) return 8.0 * static_cast<double>(numbers->size());
  double bytes = 0.0;
  for (const std::string& text : std::get<std::vector<std::string>>(coordinate.values)) {
    bytes += 24.0 + static_cast<double>(text.size());
  }
  return bytes;
}

/// Points with the padding of chunks that reach beyond the end.
double padded_points(const sweep::Layout& layout) {
  const Shape chunk = row_major_chunk(layout.shape, kChunkElements);
  double points = 1.0;
  for (std::size_t d = 0; d < layout.shape.size(); ++d) {
    const std::int64_t chunks = (layout.shape[d] + chunk[d] - 1) / chunk[d];
    points *= static_cast<double>(chunks * chunk[d]);
  }
  return points;
}

}  // namespace

double largest_result_bytes(const sweep::Layout& layout, double trace_samples) {
  constexpr double kFile = 10e3;     // superblock, text heaps
  constexpr double kStatus = 1 + 4;  // int8 and int32
  constexpr double kTrace = 2 * 8;   // start and count
  constexpr double kSample = 5 * 4;  // float32
  // Header, attributes and, of a chunked variable, the index of chunks.
  const double variable = layout.shape.empty() ? 1e3 : 4e3;
  const auto columns = static_cast<double>(layout.columns.size());
  double bytes = kFile + attribute_bytes(layout);
  for (const sweep::Coordinate& coordinate : layout.coordinates) {
    bytes += variable + coordinate_bytes(coordinate);
  }
  bytes += variable * (columns + 2.0) + (8.0 * columns + kStatus) * padded_points(layout);
  if (layout.traces) {
    const double padding = static_cast<double>(kChunkElements);
    bytes += 7.0 * variable + kTrace * padded_points(layout) + kSample * (trace_samples + padding);
  }
  return bytes;
}

}  // namespace millstudy::io
