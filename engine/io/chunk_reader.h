// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "io/hdf5.h"
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

  std::int64_t elements() const { return element_count(chunk_); }
  Run around(std::int64_t element) const { return chunk_around(shape_, chunk_, element); }

  /// The chunk that begins at an element.
  /// @return false if the library has to read it: it is not in the file, or packed in other ways;
  ///         `to` may then hold anything
  /// @throws hdf5::Error if it is damaged
  bool read(std::int64_t element, char* to) const;

 private:
  ChunkReader(hid_t dataset, const Shape& shape, Shape chunk, std::size_t size)
      : dataset_(dataset), shape_(shape), chunk_(std::move(chunk)), size_(size) {}

  hid_t dataset_;
  Shape shape_;
  Shape chunk_;
  std::size_t size_;  ///< of an element, bytes
};

}  // namespace millstudy::io
