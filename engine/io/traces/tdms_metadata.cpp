// SPDX-License-Identifier: MIT
#include "io/traces/tdms_metadata.h"

#include <algorithm>
#include <fmt/core.h>

#include "io/traces/byte_reader.h"

namespace millstudy::io::tdms {
namespace {

constexpr std::uint64_t kLeadIn = 28;  // bytes
constexpr std::uint64_t kUnfinished = ~std::uint64_t{0};

// Bits of the table of contents.
constexpr std::uint32_t kMetadata = 1u << 1;
constexpr std::uint32_t kNewObjects = 1u << 2;
constexpr std::uint32_t kRawData = 1u << 3;
constexpr std::uint32_t kInterleaved = 1u << 5;
constexpr std::uint32_t kBigEndian = 1u << 6;
constexpr std::uint32_t kDaqmx = 1u << 7;

// What stands for the index of raw data.
constexpr std::uint32_t kNoData = 0xffffffff;
constexpr std::uint32_t kAsBefore = 0;
constexpr std::uint32_t kFormatChangingScaler = 0x1269;
constexpr std::uint32_t kDigitalLineScaler = 0x1369;

/// "/'group'/'channel'", where a quote within a name is doubled; fewer names than two are no
/// channel.
std::vector<std::string> names_of(std::string_view path) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < path.size();) {
    if (path[i] != '/' || i + 1 >= path.size() || path[i + 1] != '\'') return names;
    std::string name;
    for (i += 2; i < path.size(); ++i) {
      if (path[i] == '\'') {
        if (i + 1 >= path.size() || path[i + 1] != '\'') break;
        ++i;
      }
      name += path[i];
    }
    ++i;
    names.push_back(std::move(name));
  }
  return names;
}

/// Walks over the segments.
class Walk {
 public:
  explicit Walk(const Source& source) : source_(source) {}

  Contents take() {
    std::uint64_t at = 0;
    while (at < source_.bytes.size()) at = segment(at);
    return std::move(contents_);
  }

 private:
  struct Object {
    std::size_t channel;
    bool has_data;
  };

  [[noreturn]] void fail(const std::string& text) const {
    throw core::InputError({source_.path, 0}, text);
  }

  /// Once, however many segments are so.
  void remark(const std::string& text) {
    std::vector<std::string>& remarks = contents_.remarks;
    if (std::find(remarks.begin(), remarks.end(), text) == remarks.end()) remarks.push_back(text);
  }

  /// Returns where the next segment begins.
  std::uint64_t segment(std::uint64_t at) {
    const std::uint64_t size = source_.bytes.size();
    if (size - at < kLeadIn) {
      remark("the last segment is cut off: it is left out");
      return size;
    }
    const std::string_view lead = source_.bytes.substr(at, kLeadIn);
    if (!lead.starts_with("TDSm")) fail(fmt::format("no TDMS segment begins at byte {}", at));
    const auto contents = load<std::uint32_t>(lead.data() + 4, false);
    const bool big_endian = (contents & kBigEndian) != 0;
    const auto version = load<std::uint32_t>(lead.data() + 8, big_endian);
    if (version != 4712 && version != 4713)
      fail(fmt::format("TDMS version {} is unknown", version));
    auto length = load<std::uint64_t>(lead.data() + 12, big_endian);
    const auto metadata = load<std::uint64_t>(lead.data() + 20, big_endian);
    const std::uint64_t left = size - at - kLeadIn;
    if (length == kUnfinished || length > left) {
      remark("the last segment was not finished: what there is of it was read");
      length = left;
    }
    if (metadata > length) fail(fmt::format("the segment at byte {} is damaged or cut off", at));
    if ((contents & kNewObjects) != 0) active_.clear();
    if ((contents & kMetadata) != 0) {
      read_metadata({source_.path, fmt::format("the metadata of the segment at byte {}", at),
                     source_.bytes.substr(at + kLeadIn, metadata), big_endian});
    }
    if ((contents & kRawData) != 0) {
      add_blocks(at + kLeadIn + metadata, length - metadata, contents);
    }
    return at + kLeadIn + length;
  }

  void read_metadata(ByteReader reader) {
    const auto objects = reader.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < objects; ++i) {
      const std::string path(reader.bytes(reader.number<std::uint32_t>()));
      Channel& channel = contents_.channels[find(path)];
      const bool has_data = read_index(reader, channel);
      activate(index_.at(path), has_data);
      const auto properties = reader.number<std::uint32_t>();
      for (std::uint32_t k = 0; k < properties; ++k) read_property(reader, channel);
    }
  }

  /// The index of a path; groups and the file itself are channels without names, never with data.
  std::size_t find(const std::string& path) {
    const auto [entry, added] = index_.try_emplace(path, contents_.channels.size());
    if (added) {
      std::vector<std::string> names = names_of(path);
      Channel channel;
      if (!names.empty()) channel.group = std::move(names[0]);
      if (names.size() > 1) channel.name = std::move(names[1]);
      contents_.channels.push_back(std::move(channel));
      place_.push_back(kNowhere);
    }
    return entry->second;
  }

  /// Whether the channel has data in this segment.
  bool read_index(ByteReader& reader, Channel& channel) {
    const auto length = reader.number<std::uint32_t>();
    if (length == kNoData) return false;
    if (length == kAsBefore) {
      if (!channel.indexed) fail(fmt::format("channel {} has no index of its data", channel.name));
      return true;
    }
    channel.indexed = true;
    if (length == kFormatChangingScaler || length == kDigitalLineScaler) {
      read_daqmx_index(reader, channel);
      return true;
    }
    channel.type = static_cast<Type>(reader.number<std::uint32_t>());
    if (reader.number<std::uint32_t>() != 1) fail("an array has more than one dimension");
    channel.count = reader.number<std::uint64_t>();
    const std::uint64_t size = size_of(channel.type);
    if (channel.type == Type::kString) {
      channel.bytes = reader.number<std::uint64_t>();
    } else if (size == 0) {
      fail(fmt::format("channel {} has values of the unknown type {:#x}", channel.name,
                       static_cast<std::uint32_t>(channel.type)));
    } else if (channel.count > source_.bytes.size() / size + 1) {
      // More than the file can hold: an unfinished segment, or a damaged one.
      channel.bytes = kUnfinished;
    } else {
      channel.bytes = channel.count * size;
    }
    return true;
  }

  /// Only passed over: such channels are refused when they are asked for.
  static void read_daqmx_index(ByteReader& reader, Channel& channel) {
    channel.daqmx = true;
    reader.bytes(4 + 4);  // type, dimension
    channel.count = reader.number<std::uint64_t>();
    channel.bytes = 0;
    const auto scalers = reader.number<std::uint32_t>();
    reader.bytes(std::uint64_t{scalers} * 20);
    const auto widths = reader.number<std::uint32_t>();
    reader.bytes(std::uint64_t{widths} * 4);
  }

  void activate(std::size_t channel, bool has_data) {
    if (place_[channel] < active_.size() && active_[place_[channel]].channel == channel) {
      active_[place_[channel]].has_data = has_data;
      return;
    }
    place_[channel] = active_.size();
    active_.push_back({channel, has_data});
  }

  void read_property(ByteReader& reader, Channel& channel) const {
    const std::string name(reader.bytes(reader.number<std::uint32_t>()));
    Property& value = channel.properties[name];
    const auto type = static_cast<Type>(reader.number<std::uint32_t>());
    switch (type) {
      case Type::kString:
        value = std::string(reader.bytes(reader.number<std::uint32_t>()));
        return;
      case Type::kInt8:
        value = static_cast<double>(reader.number<std::int8_t>());
        return;
      case Type::kInt16:
        value = static_cast<double>(reader.number<std::int16_t>());
        return;
      case Type::kInt32:
        value = static_cast<double>(reader.number<std::int32_t>());
        return;
      case Type::kInt64:
        value = static_cast<double>(reader.number<std::int64_t>());
        return;
      case Type::kBool:
      case Type::kUint8:
        value = static_cast<double>(reader.number<std::uint8_t>());
        return;
      case Type::kUint16:
        value = static_cast<double>(reader.number<std::uint16_t>());
        return;
      case Type::kUint32:
        value = static_cast<double>(reader.number<std::uint32_t>());
        return;
      case Type::kUint64:
        value = static_cast<double>(reader.number<std::uint64_t>());
        return;
      case Type::kFloatWithUnit:
      case Type::kFloat:
        value = static_cast<double>(reader.number<float>());
        return;
      case Type::kDoubleWithUnit:
      case Type::kDouble:
        value = reader.number<double>();
        return;
      default:
        break;
    }
    const std::size_t size = size_of(type);
    if (size == 0 && type != Type::kVoid) {
      fail(fmt::format("property {} has the unknown type {:#x}", name,
                       static_cast<std::uint32_t>(type)));
    }
    reader.bytes(size);
    value = std::string();
  }

  void add_blocks(std::uint64_t begin, std::uint64_t length, std::uint32_t contents) {
    if ((contents & kDaqmx) != 0) {
      for (const Object& object : active_) {
        if (object.has_data) contents_.channels[object.channel].daqmx = true;
      }
      return;
    }
    const bool interleaved = (contents & kInterleaved) != 0;
    // Interleaved, a row has one value of each channel.
    std::uint64_t chunk = 0;
    for (const Object& object : active_) {
      if (!object.has_data) continue;
      const Channel& channel = contents_.channels[object.channel];
      if (channel.daqmx) return;
      const std::uint64_t bytes = interleaved ? size_of(channel.type) : channel.bytes;
      chunk = bytes > kUnfinished - chunk ? kUnfinished : chunk + bytes;
    }
    if (chunk == 0) return;
    const std::uint64_t chunks = length / chunk;
    if (length % chunk != 0) {
      remark("a chunk that was not finished is left out");
    }
    if (chunks == 0) return;
    std::uint64_t offset = begin;
    for (const Object& object : active_) {
      if (!object.has_data) continue;
      const Channel& channel = contents_.channels[object.channel];
      const std::uint64_t size = size_of(channel.type);
      const bool big_endian = (contents & kBigEndian) != 0;
      if (interleaved) {
        if (channel.type == Type::kString) fail("texts are interleaved with numbers");
        contents_.blocks.push_back(
            {object.channel, offset, chunks, chunk, 1, 0, channel.type, big_endian});
      } else {
        contents_.blocks.push_back(
            {object.channel, offset, channel.count, size, chunks, chunk, channel.type, big_endian});
      }
      offset += interleaved ? size : channel.bytes;
    }
  }

  static constexpr std::size_t kNowhere = ~std::size_t{0};
  const Source& source_;
  Contents contents_;
  std::map<std::string, std::size_t> index_;  ///< of a channel by its path
  std::vector<Object> active_;                ///< in the order of their data
  std::vector<std::size_t> place_;            ///< of a channel in active_
};

}  // namespace

std::size_t size_of(Type type) {
  switch (type) {
    case Type::kInt8:
    case Type::kUint8:
    case Type::kBool:
      return 1;
    case Type::kInt16:
    case Type::kUint16:
      return 2;
    case Type::kInt32:
    case Type::kUint32:
    case Type::kFloat:
    case Type::kFloatWithUnit:
      return 4;
    case Type::kInt64:
    case Type::kUint64:
    case Type::kDouble:
    case Type::kDoubleWithUnit:
    case Type::kComplexFloat:
      return 8;
    case Type::kTimestamp:
    case Type::kComplexDouble:
      return 16;
    case Type::kVoid:
    case Type::kString:
      return 0;
  }
  return 0;
}

bool is_number(Type type) {
  return size_of(type) > 0 && type != Type::kBool && type != Type::kTimestamp &&
         type != Type::kComplexFloat && type != Type::kComplexDouble;
}

std::optional<double> Channel::number(const std::string& property) const {
  const auto found = properties.find(property);
  if (found == properties.end() || !std::holds_alternative<double>(found->second)) return {};
  return std::get<double>(found->second);
}

std::string Channel::text(const std::string& property) const {
  const auto found = properties.find(property);
  if (found == properties.end() || !std::holds_alternative<std::string>(found->second)) return {};
  return std::get<std::string>(found->second);
}

Contents read_contents(const Source& source) {
  return Walk(source).take();
}

}  // namespace millstudy::io::tdms
