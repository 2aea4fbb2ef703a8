// SPDX-License-Identifier: MIT
// NI TDMS: which channels are read, their values and scales.
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "io/traces/byte_reader.h"
#include "io/traces/format.h"
#include "io/traces/range.h"
#include "io/traces/tdms_metadata.h"
#include "io/traces/tdms_scale.h"

namespace millstudy::io {
namespace {

using tdms::Block;
using tdms::Channel;
using tdms::Contents;
using tdms::Type;

constexpr const char* kName = "NI TDMS";

bool recognise(std::string_view bytes) {
  return bytes.starts_with("TDSm");
}

std::string full_name(const Channel& channel) {
  return channel.group + '/' + channel.name;
}

std::vector<std::string> names_of(const Contents& contents) {
  std::vector<std::string> names;
  for (const Channel& channel : contents.channels) {
    if (!channel.name.empty()) names.push_back(full_name(channel));
  }
  return names;
}

/// "group/channel", or "channel" where only one group has it.
std::size_t find_channel(const Source& source, const Contents& contents,
                         const std::string& wanted) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < contents.channels.size(); ++i) {
    const Channel& channel = contents.channels[i];
    if (channel.name.empty()) continue;
    if (full_name(channel) == wanted) return i;
    if (channel.name == wanted) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  std::string names;
  for (const std::string& name : names_of(contents)) {
    if (names.size() < 200) names += (names.empty() ? "" : ", ") + name;
  }
  throw core::InputError(
      {source.path, 0},
      found.empty() ? fmt::format("has no channel {}; it has {}", wanted, names)
                    : fmt::format("channel {} is in several groups: write group/channel", wanted));
}

template <class T>
void append(std::string_view bytes, const Block& block, std::vector<double>& to) {
  const char* chunk = bytes.data() + block.offset;
  for (std::uint64_t k = 0; k < block.chunks; ++k, chunk += block.chunk_bytes) {
    const char* at = chunk;
    for (std::uint64_t i = 0; i < block.count; ++i, at += block.stride) {
      to.push_back(static_cast<double>(load<T>(at, block.big_endian)));
    }
  }
}

void append(std::string_view bytes, const Block& block, std::vector<double>& to) {
  switch (block.type) {
    case Type::kInt8:
      return append<std::int8_t>(bytes, block, to);
    case Type::kInt16:
      return append<std::int16_t>(bytes, block, to);
    case Type::kInt32:
      return append<std::int32_t>(bytes, block, to);
    case Type::kInt64:
      return append<std::int64_t>(bytes, block, to);
    case Type::kUint8:
      return append<std::uint8_t>(bytes, block, to);
    case Type::kUint16:
      return append<std::uint16_t>(bytes, block, to);
    case Type::kUint32:
      return append<std::uint32_t>(bytes, block, to);
    case Type::kUint64:
      return append<std::uint64_t>(bytes, block, to);
    case Type::kFloat:
    case Type::kFloatWithUnit:
      return append<float>(bytes, block, to);
    default:
      return append<double>(bytes, block, to);
  }
}

void check_readable(const Source& source, const Contents& contents, std::size_t index) {
  const Channel& channel = contents.channels[index];
  const auto fail = [&](const char* what) {
    throw core::InputError({source.path, 0},
                           fmt::format("channel {} {}", full_name(channel), what));
  };
  if (channel.daqmx) {
    fail(
        "holds raw data of a DAQmx device, which are values only with its scalers: convert the "
        "file, or log scaled data");
  }
  for (const Block& block : contents.blocks) {
    if (block.channel == index && !tdms::is_number(block.type)) {
      fail("holds no numbers, but texts, times, truth or complex values");
    }
  }
}

std::vector<double> values_of(const Source& source, const Contents& contents, std::size_t index,
                              std::size_t most) {
  check_readable(source, contents, index);
  const std::optional<tdms::Scale> scale = tdms::scale_of(source, contents.channels[index]);
  std::uint64_t total = 0;
  for (const Block& block : contents.blocks) {
    // Each value has bytes of its own in the file: neither product nor sum can overflow.
    if (block.channel == index) total += block.count * block.chunks;
  }
  if (total > most) {
    throw core::InputError({source.path, 0}, fmt::format("more than {} values: read fewer channels",
                                                         kMostTraceValues));
  }
  std::vector<double> values;
  values.reserve(total);
  for (const Block& block : contents.blocks) {
    if (block.channel == index) append(source.bytes, block, values);
  }
  if (scale) {
    for (double& value : values) value = tdms::apply(*scale, value);
  }
  return values;
}

std::string unit_of(const Channel& channel) {
  const std::string unit = channel.text("unit_string");
  return unit.empty() ? channel.text("NI_UnitDescription") : unit;
}

/// Rate and start by the properties of a waveform, which must be those of all channels.
void read_waveform(const Source& source, const Channel& channel, bool first,
                   identify::ChannelSet& set) {
  const std::optional<double> step = channel.number("wf_increment");
  std::optional<double> rate;
  if (step && std::isfinite(*step) && *step > 0.0) rate = 1.0 / *step;
  const double start = channel.number("wf_start_offset").value_or(0.0);
  if (first) {
    set.sampling_rate = rate;
    set.start = std::isfinite(start) ? start : 0.0;
  } else if (rate != set.sampling_rate) {
    throw core::InputError(
        {source.path, 0},
        fmt::format("channel {} has {}, another {}", full_name(channel),
                    rate ? fmt::format("{} Hz", *rate) : "no sampling rate",
                    set.sampling_rate ? fmt::format("{} Hz", *set.sampling_rate) : "none"));
  }
}

TraceFile read(const Source& source, const TraceSelection& selection) {
  const Contents contents = tdms::read_contents(source);
  std::vector<std::pair<std::string, std::size_t>> wanted;
  for (const auto& [name, variable] : selection.variables) {
    wanted.emplace_back(name, find_channel(source, contents, variable));
  }
  if (wanted.empty()) {
    for (std::size_t i = 0; i < contents.channels.size(); ++i) {
      const Channel& channel = contents.channels[i];
      if (channel.name.empty() || !channel.indexed) continue;
      wanted.emplace_back(full_name(channel), i);
    }
  }
  TraceFile file{kName, {}};
  identify::ChannelSet& set = file.channels;
  set.remarks = contents.remarks;
  std::size_t left = kMostTraceValues;
  for (const auto& [name, index] : wanted) {
    const Channel& channel = contents.channels[index];
    std::vector<double> values = values_of(source, contents, index, left);
    left -= values.size();
    cut_to_range(values, selection.range);
    if (name == "time") {
      set.time = std::move(values);
      continue;
    }
    read_waveform(source, channel, set.channels.empty(), set);
    set.channels.push_back({name, unit_of(channel), std::move(values)});
  }
  shift_start(set, selection.range);
  return file;
}

std::vector<std::string> variables(const Source& source) {
  return names_of(tdms::read_contents(source));
}

}  // namespace

const TraceFormat kTdms = {kName, recognise, read, variables};

}  // namespace millstudy::io
