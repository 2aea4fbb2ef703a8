// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "io/packed_points.h"
#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::io {

/// A result file read back as the blocks it was written from.
class ResultBlocks {
 public:
  /// @throws core::InputError if the file is no result that this program wrote
  explicit ResultBlocks(const std::string& path);
  ~ResultBlocks();
  ResultBlocks(ResultBlocks&&) noexcept;

  const std::string& path() const;
  /// All that the file says but the results.
  const sweep::Layout& layout() const;

  /// Points first .. first + count - 1, bit for bit as they were written; without values and traces
  /// where none of them was run.
  /// @throws core::InputError if the file is damaged
  sweep::Block read(std::int64_t first, std::int64_t count) const;
  /// The same into a block whose memory is used again.
  void read(std::int64_t first, std::int64_t count, sweep::Block& block) const;

  /// The points of the chunk that begins with one, without unpacking more than their status: what
  /// is packed is not checked.
  ///
  /// @return false if they have to be read: not all of them are ok, `first` is not where a chunk
  ///         begins, it ends past `end`, or there are time histories, which know their place
  /// @throws core::InputError if the file is damaged
  bool read_packed(std::int64_t first, std::int64_t end, PackedPoints& points) const;

  /// Past the last point of the chunk that a point is in; only of a layout() with chunks.
  std::int64_t chunk_end(std::int64_t point) const;

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

}  // namespace millstudy::io
