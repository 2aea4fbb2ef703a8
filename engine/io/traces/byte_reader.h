// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.h"

namespace millstudy::io {

/// A number as its bytes stand in a file. No alignment is needed.
template <class T>
T load(const char* bytes, bool big_endian) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) {
    std::reverse(copy.begin(), copy.end());
  }
  T value;
  std::memcpy(&value, copy.data(), sizeof(T));
  return value;
}

/// Reads a part of a binary file from its beginning to its end, never beyond.
class ByteReader {
 public:
  /// @param what  the part, for the message when it is too short
  ByteReader(std::string file, std::string what, std::string_view bytes, bool big_endian)
      : file_(std::move(file)), what_(std::move(what)), rest_(bytes), big_endian_(big_endian) {}

  template <class T>
  T number() {
    return load<T>(bytes(sizeof(T)).data(), big_endian_);
  }
  std::string_view bytes(std::uint64_t count) {
    if (count > rest_.size()) throw core::InputError({file_, 0}, what_ + " is cut off or damaged");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string file_;
  std::string what_;
  std::string_view rest_;
  bool big_endian_;
};

}  // namespace millstudy::io
