// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/traces/source.h"

/// Structure of NI TDMS files. Specification: ni.com, "TDMS File Format Internal Structure".
namespace millstudy::io::tdms {

/// Types of numbers, as coded in the file.
enum class Type : std::uint32_t {
  kVoid = 0,
  kInt8 = 1,
  kInt16 = 2,
  kInt32 = 3,
  kInt64 = 4,
  kUint8 = 5,
  kUint16 = 6,
  kUint32 = 7,
  kUint64 = 8,
  kFloat = 9,
  kDouble = 10,
  kFloatWithUnit = 0x19,
  kDoubleWithUnit = 0x1a,
  kString = 0x20,
  kBool = 0x21,
  kTimestamp = 0x44,
  kComplexFloat = 0x08000c,
  kComplexDouble = 0x10000d,
};

/// Bytes of one value; 0: not fixed, or unknown.
std::size_t size_of(Type type);
/// Whether values of a channel of this type can be forces.
bool is_number(Type type);

using Property = std::variant<double, std::string>;

/// A channel: its path in the file, and what the segments so far say of it.
struct Channel {
  std::string group;
  std::string name;
  std::map<std::string, Property> properties;
  Type type = Type::kVoid;
  std::uint64_t count = 0;  ///< values in one chunk of a segment
  std::uint64_t bytes = 0;  ///< of one chunk
  bool daqmx = false;       ///< some of its data are values only after DAQmx scalers
  bool indexed = false;     ///< type, count and bytes are known

  std::optional<double> number(const std::string& property) const;
  std::string text(const std::string& property) const;  ///< empty: not there
};

/// Where values of one channel stand in one segment: chunks of equally many.
struct Block {
  std::size_t channel = 0;   ///< index
  std::uint64_t offset = 0;  ///< of the first value in the file [bytes]
  std::uint64_t count = 0;   ///< values in one chunk
  std::uint64_t stride = 0;  ///< from value to value [bytes]
  std::uint64_t chunks = 0;
  std::uint64_t chunk_bytes = 0;  ///< from chunk to chunk
  Type type = Type::kVoid;
  bool big_endian = false;
};

/// All channels, and where their values are. Every block lies within the file.
struct Contents {
  std::vector<Channel> channels;  ///< in the order of the file
  std::vector<Block> blocks;
  std::vector<std::string> remarks;
};

/// Reads the metadata of all segments.
///
/// @throws core::InputError for a damaged file
Contents read_contents(const Source& source);

}  // namespace millstudy::io::tdms
