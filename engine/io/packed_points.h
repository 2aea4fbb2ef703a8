// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace millstudy::io {

/// A chunk as it is in a file; no bytes: all its elements are the fill value.
struct PackedChunk {
  std::vector<std::byte> bytes;
  std::uint32_t skipped = 0;  ///< filters that it went past: 0, or all
};

/// Points that fill a chunk of every variable, all of them ok, packed as they are in a file.
struct PackedPoints {
  std::int64_t first = 0;
  std::int64_t count = 0;
  std::vector<PackedChunk> columns;
  PackedChunk status;
};

}  // namespace millstudy::io
