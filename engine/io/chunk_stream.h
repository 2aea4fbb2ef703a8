// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/hdf5.h"
#include "io/row_major.h"

namespace millstudy::io {

/// The library's name of a C++ type in memory.
template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::int8_t>) return H5T_NATIVE_INT8;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
}

/// Fills a variable from its first element to its last in row-major order, in pieces of any size.
///
/// Holds back at most one chunk, so that every chunk is compressed once and written whole.
template <class T>
class ChunkStream {
 public:
  /// @param shape  of the variable; {0} of an unlimited one, which grows
  /// @param chunk  as row_major_chunk gives it; of any size for a scalar
  ChunkStream(hdf5::Handle dataset, Shape shape, Shape chunk)
      : dataset_(std::move(dataset)),
        shape_(std::move(shape)),
        chunk_(std::move(chunk)),
        unlimited_(shape_.size() == 1 && shape_[0] == 0) {}

  void append(std::span<const T> values) {
    while (!values.empty()) {
      const std::int64_t room = end() - next_ - static_cast<std::int64_t>(held_.size());
      const std::size_t taken = std::min(values.size(), static_cast<std::size_t>(room));
      held_.insert(held_.end(), values.begin(), values.begin() + taken);
      values = values.subspan(taken);
      if (static_cast<std::int64_t>(taken) == room) flush();
    }
  }

  /// Writes what is held back.
  void flush() {
    if (held_.empty()) return;
    const auto count = static_cast<std::int64_t>(held_.size());
    if (unlimited_) {
      shape_[0] = next_ + count;
      hdf5::extend(dataset_.get(), shape_[0]);
    }
    hdf5::write_range(dataset_.get(), memory_type<T>(), shape_, next_, count, held_.data());
    next_ += count;
    held_.clear();
  }

  hid_t dataset() const { return dataset_.get(); }

 private:
  /// Where the chunk being filled ends.
  std::int64_t end() const {
    if (unlimited_) return (next_ / chunk_[0] + 1) * chunk_[0];
    return chunk_end(shape_, chunk_, next_);
  }

  hdf5::Handle dataset_;
  Shape shape_;
  Shape chunk_;
  bool unlimited_;
  std::int64_t next_ = 0;  // first element not in the file
  std::vector<T> held_;
};

}  // namespace millstudy::io
