// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "io/hdf5.h"
#include "io/packed_points.h"
#include "io/row_major.h"

namespace millstudy::io {

/// Reads whole chunks of a variable past the library, which would copy them through its cache box
/// by box, and unpack them while all other threads wait for its lock.
///
/// For variables of numbers as they are in memory, in chunks that are runs of the row-major order
/// and went through byte shuffle and gzip or past both: those that this program writes.
class ChunkReader {
 public:
  /// @return nothing where the variable is none of these
  static std::optional<ChunkReader> of(hid_t dataset, hid_t memory_type, const Shape& shape);

  const Shape& chunk() const { return chunk_; }
  std::int64_t elements() const { return element_count(chunk_); }
  Run around(std::int64_t element) const { return chunk_around(shape_, chunk_, element); }

  /// The chunk that begins at an element.
  /// @return false if the library has to read it: it is not in the file, or packed in other ways;
  ///         `to` may then hold anything
  /// @throws hdf5::Error if it is damaged
  bool read(std::int64_t element, char* to) const;

  /// The same without unpacking it.
  bool read_packed(std::int64_t element, PackedChunk& to) const;

 private:
  ChunkReader(hid_t dataset, const Shape& shape, Shape chunk, std::size_t size)
      : dataset_(dataset), shape_(shape), chunk_(std::move(chunk)), size_(size) {}

  std::size_t bytes() const { return static_cast<std::size_t>(elements()) * size_; }
  /// Of the chunk that begins at an element, in the file; 0 if it is not there or not to be found.
  std::size_t stored_bytes(const std::vector<hsize_t>& place) const;
  std::vector<hsize_t> place_of(std::int64_t element) const;

  hid_t dataset_;
  Shape shape_;
  Shape chunk_;
  std::size_t size_;  ///< of an element, bytes
};

}  // namespace millstudy::io
