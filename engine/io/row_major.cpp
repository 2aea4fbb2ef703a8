// SPDX-License-Identifier: MIT
#include "io/row_major.h"

#include <algorithm>

namespace millstudy::io {
namespace {

/// Adds the boxes of a range within the sub-array that prefix points at (its leading indices).
void add_boxes(std::span<const std::int64_t> shape, const Shape& prefix, std::int64_t begin,
               std::int64_t end, std::vector<Box>& boxes) {
  if (begin >= end) return;
  const std::size_t dimension = prefix.size();
  const std::int64_t inner =
      dimension < shape.size() ? element_count(shape.subspan(dimension + 1)) : 1;
  const auto descend = [&](std::int64_t index, std::int64_t from, std::int64_t to) {
    Shape longer = prefix;
    longer.push_back(index);
    add_boxes(shape, longer, from, to, boxes);
  };
  std::int64_t first = begin / inner;
  const std::int64_t last = end / inner;
  if (begin % inner != 0) {
    descend(first, begin % inner, std::min(inner, end - first * inner));
    ++first;
  }
  if (first < last) {
    Box box{Shape(shape.size(), 0), Shape(shape.begin(), shape.end())};
    std::copy(prefix.begin(), prefix.end(), box.start.begin());
    std::fill_n(box.count.begin(), dimension, 1);
    if (dimension < shape.size()) {
      box.start[dimension] = first;
      box.count[dimension] = last - first;
    }
    boxes.push_back(std::move(box));
  }
  if (first <= last && end % inner != 0) descend(last, 0, end % inner);
}

}  // namespace

std::int64_t element_count(std::span<const std::int64_t> shape) {
  std::int64_t product = 1;
  for (const std::int64_t length : shape) product *= length;
  return product;
}

std::vector<Box> row_major_boxes(std::span<const std::int64_t> shape, std::int64_t begin,
                                 std::int64_t end) {
  std::vector<Box> boxes;
  add_boxes(shape, {}, begin, end, boxes);
  return boxes;
}

Shape row_major_chunk(std::span<const std::int64_t> shape, std::int64_t largest) {
  Shape chunk(shape.size(), 1);
  std::int64_t inner = 1;
  for (std::size_t d = shape.size(); d-- > 0;) {
    const std::int64_t length = std::max<std::int64_t>(shape[d], 1);
    const std::int64_t most = std::max<std::int64_t>(largest / inner, 1);
    const std::int64_t pieces = (length + most - 1) / most;
    chunk[d] = (length + pieces - 1) / pieces;
    if (pieces > 1) break;
    inner *= length;
  }
  return chunk;
}

bool is_row_major(std::span<const std::int64_t> shape, std::span<const std::int64_t> chunk) {
  if (chunk.size() != shape.size()) return false;
  bool whole = true;  // so are all dimensions that come after
  for (std::size_t d = chunk.size(); d-- > 0;) {
    if (chunk[d] < 1 || chunk[d] > shape[d] || (!whole && chunk[d] != 1)) return false;
    whole = whole && chunk[d] == shape[d];
  }
  return true;
}

Run chunk_around(std::span<const std::int64_t> shape, std::span<const std::int64_t> chunk,
                 std::int64_t element) {
  if (shape.empty()) return {0, 1};
  std::size_t split = 0;
  while (split + 1 < shape.size() && chunk[split] == 1) ++split;
  const std::int64_t inner = element_count(shape.subspan(split + 1));
  const std::int64_t row = shape[split] * inner;
  const std::int64_t size = chunk[split] * inner;
  const std::int64_t in_row = element % row;
  const std::int64_t in_chunk = in_row % size;
  return {element - in_chunk, element + std::min(row - in_row, size - in_chunk)};
}

}  // namespace millstudy::io
