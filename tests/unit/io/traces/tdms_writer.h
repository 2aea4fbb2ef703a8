// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace millstudy::io {

/// Writes TDMS files byte by byte, as the published format says, of either byte order.
class TdmsBytes {
 public:
  explicit TdmsBytes(bool big_endian = false) : big_endian_(big_endian) {}

  template <class T>
  TdmsBytes& number(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (big_endian_ != (std::endian::native == std::endian::big)) {
      std::reverse(bytes, bytes + sizeof(T));
    }
    text_.append(bytes, sizeof(T));
    return *this;
  }
  TdmsBytes& u32(std::uint32_t value) { return number(value); }
  TdmsBytes& u64(std::uint64_t value) { return number(value); }
  TdmsBytes& text(const std::string& value) {
    u32(static_cast<std::uint32_t>(value.size()));
    text_ += value;
    return *this;
  }
  /// Begins an object with an index of raw data.
  TdmsBytes& object(const std::string& path, std::uint32_t type, std::uint64_t count) {
    return text(path).u32(20).u32(type).u32(1).u64(count);
  }
  TdmsBytes& object_without_data(const std::string& path) { return text(path).u32(0xffffffff); }
  TdmsBytes& object_as_before(const std::string& path) { return text(path).u32(0); }
  TdmsBytes& property(const std::string& name, double value) {
    return text(name).u32(10).number(value);
  }
  TdmsBytes& property(const std::string& name, std::uint32_t value) {
    return text(name).u32(7).number(value);
  }
  TdmsBytes& property(const std::string& name, const std::string& value) {
    return text(name).u32(0x20).text(value);
  }
  const std::string& bytes() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

inline constexpr std::uint32_t kTdmsMeta = 2, kTdmsNew = 4, kTdmsRaw = 8, kTdmsInterleaved = 32,
                               kTdmsBig = 64, kTdmsDaqmx = 128;

/// A segment; the length is that of its parts unless another is given.
inline std::string tdms_segment(std::uint32_t contents, const std::string& metadata,
                                const std::string& raw, std::uint32_t version = 4713,
                                std::uint64_t length = 0) {
  const bool big_endian = (contents & kTdmsBig) != 0;
  TdmsBytes order;  // the table of contents is little-endian always
  order.u32(contents);
  TdmsBytes rest(big_endian);
  rest.u32(version).u64(length != 0 ? length : metadata.size() + raw.size()).u64(metadata.size());
  return "TDSm" + order.bytes() + rest.bytes() + metadata + raw;
}

}  // namespace millstudy::io
