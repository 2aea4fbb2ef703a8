// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace millstudy::io {

using Shape = std::vector<std::int64_t>;

/// Number of elements; 1 for no dimension.
std::int64_t element_count(std::span<const std::int64_t> shape);

/// A rectangular part of an array: start and count for every dimension.
struct Box {
  Shape start;
  Shape count;
};

/// The elements begin .. end - 1 of an array, counted in row-major order, as boxes.
///
/// The boxes, one after another and each in row-major order, are the range in its order. At most
/// 2 rank - 1 of them (one for no dimension).
///
/// @param shape  lengths of the array, outermost first, each > 0
/// @param begin  >= 0
/// @param end    begin <= end <= element_count(shape); begin == end gives no box
std::vector<Box> row_major_boxes(std::span<const std::int64_t> shape, std::int64_t begin,
                                 std::int64_t end);

/// A chunk shape whose every chunk is one run of the row-major order: 1, ..., 1, k, full, full.
///
/// The split dimension is cut evenly, so that a chunk of a large array has between largest / 2 and
/// largest elements and the last one of a row is not almost empty.
///
/// @param largest  most elements of a chunk, >= 1
/// @return shape of a chunk, each >= 1
Shape row_major_chunk(std::span<const std::int64_t> shape, std::int64_t largest);

/// True if chunks of this shape are such runs.
bool is_row_major(std::span<const std::int64_t> shape, std::span<const std::int64_t> chunk);

/// Elements begin .. end - 1 of an array, in row-major order.
struct Run {
  std::int64_t begin;
  std::int64_t end;
};

/// The chunk that holds an element.
/// @param chunk  is_row_major()
Run chunk_around(std::span<const std::int64_t> shape, std::span<const std::int64_t> chunk,
                 std::int64_t element);

}  // namespace millstudy::io
