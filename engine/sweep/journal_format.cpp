// SPDX-License-Identifier: MIT
#include "sweep/journal_format.h"

#include <bit>
#include <cstring>

#include "core/crc32c.h"

static_assert(std::endian::native == std::endian::little, "a journal is little endian");

namespace millstudy::sweep {
namespace {

constexpr std::size_t kLongestText = 64 << 20;  // of a header

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void put_all(const std::vector<T>& values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
  }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what Writer wrote; once there is too little left, everything fails.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  bool get(T& value) {
    if (rest_.size() < sizeof value) return false;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return true;
  }
  template <class T>
  bool get_all(std::vector<T>& values, std::size_t count) {
    if (rest_.size() / sizeof(T) < count) return false;
    if (count == 0) return true;
    values.resize(count);
    std::memcpy(values.data(), rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
    return true;
  }
  bool get_text(std::string& text) {
    std::uint32_t size = 0;
    if (!get(size) || rest_.size() < size) return false;
    text = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

/// The beginning of a payload: first, count, times, status of every point.
bool get_beginning(Reader& reader, const JournalHeader& header, std::int64_t index,
                   BlockTimes& times, std::vector<Status>& status) {
  std::int64_t first = 0, count = 0;
  if (index < 0 || index >= header.blocks()) return false;
  if (!reader.get(first) || !reader.get(count)) return false;
  if (first != header.first_of(index) || count != header.count_of(index)) return false;
  if (!reader.get(times.seconds) || !reader.get(times.elapsed) || !reader.get(times.session)) {
    return false;
  }
  if (!reader.get_all(status, static_cast<std::size_t>(count))) return false;
  for (const Status one : status) {
    if (one < Status::ok || one > Status::not_run) return false;
  }
  return true;
}

bool get_trace(Reader& reader, Trace& trace) {
  std::uint64_t samples = 0;
  if (!reader.get(samples)) return false;
  for (std::vector<float>* channel :
       {&trace.time, &trace.angle, &trace.force_x, &trace.force_y, &trace.force_z}) {
    if (!reader.get_all(*channel, samples)) return false;
  }
  return true;
}

}  // namespace

std::string encode_header(const JournalHeader& header) {
  Writer fields;
  for (const std::string* text : {&header.study_hash, &header.isa, &header.build, &header.study}) {
    fields.put_text(*text);
  }
  for (const std::int64_t number :
       {header.points, header.first, header.count, header.block_size, header.columns}) {
    fields.put(number);
  }
  fields.put(static_cast<std::uint8_t>(header.traces));
  fields.put(static_cast<std::uint8_t>(header.keep_old));
  Writer all;
  all.bytes() = kJournalMagic;
  all.put(kJournalVersion);
  all.put(static_cast<std::uint32_t>(fields.bytes().size()));
  std::uint32_t checksum = core::crc32c(all.bytes().data(), all.bytes().size());
  checksum = core::crc32c(fields.bytes().data(), fields.bytes().size(), checksum);
  all.bytes().append(kOwnerSize, '\0');
  all.bytes() += fields.bytes();
  all.put(checksum);
  return std::move(all.bytes());
}

std::optional<JournalHeader> decode_header(std::string_view bytes) {
  Reader beginning(bytes.substr(0, kOwnerPlace));
  std::uint64_t magic = 0;
  std::uint32_t version = 0, length = 0, stored = 0;
  if (!beginning.get(magic) || !beginning.get(version) || !beginning.get(length)) {
    return std::nullopt;
  }
  if (!bytes.starts_with(kJournalMagic) || version != kJournalVersion || length > kLongestText ||
      bytes.size() < kHeaderPlace + length + sizeof stored) {
    return std::nullopt;
  }
  const std::string_view fields = bytes.substr(kHeaderPlace, length);
  Reader end(bytes.substr(kHeaderPlace + length));
  end.get(stored);
  const std::uint32_t checksum =
      core::crc32c(fields.data(), fields.size(), core::crc32c(bytes.data(), kOwnerPlace));
  if (checksum != stored) return std::nullopt;
  JournalHeader header;
  Reader reader(fields);
  std::uint8_t traces = 0, keep_old = 0;
  for (std::string* text : {&header.study_hash, &header.isa, &header.build, &header.study}) {
    if (!reader.get_text(*text)) return std::nullopt;
  }
  for (std::int64_t* number :
       {&header.points, &header.first, &header.count, &header.block_size, &header.columns}) {
    if (!reader.get(*number)) return std::nullopt;
  }
  if (!reader.get(traces) || !reader.get(keep_old) || !reader.at_end()) return std::nullopt;
  header.traces = traces != 0;
  header.keep_old = keep_old != 0;
  constexpr std::int64_t kMost = std::int64_t{1} << 48;
  const bool sound = header.points >= 0 && header.points < kMost && header.first >= 0 &&
                     header.count >= 0 && header.first <= header.points - header.count &&
                     header.block_size >= 1 && header.block_size < kMost && header.columns >= 0 &&
                     header.columns < 1'000'000;
  if (!sound) return std::nullopt;
  return header;
}

std::string encode_frame(std::int64_t index, const Block& block, const BlockTimes& times) {
  Writer frame;
  frame.put(kFrameMarker);
  frame.put(std::uint32_t{0});
  frame.put(std::uint64_t{0});
  frame.put(static_cast<std::uint64_t>(index));
  frame.put(block.first);
  frame.put(block.count);
  frame.put(times.seconds);
  frame.put(times.elapsed);
  frame.put(times.session);
  frame.put_all(block.status);
  frame.put_all(block.values);
  for (std::int64_t i = 0; i < block.count; ++i) {
    if (block.status[i] == Status::failed) frame.put_text(block.failures[i]);
  }
  for (const Trace& trace : block.traces) {
    frame.put(static_cast<std::uint64_t>(trace.time.size()));
    for (const std::vector<float>* channel :
         {&trace.time, &trace.angle, &trace.force_x, &trace.force_y, &trace.force_z}) {
      frame.put_all(*channel);
    }
  }
  std::string& bytes = frame.bytes();
  const std::uint64_t length = bytes.size() - kFrameHead;
  std::memcpy(bytes.data() + 8, &length, sizeof length);
  const std::uint32_t checksum = core::crc32c(bytes.data() + 8, bytes.size() - 8);
  std::memcpy(bytes.data() + 4, &checksum, sizeof checksum);
  return std::move(bytes);
}

std::optional<FrameHead> decode_head(std::string_view bytes) {
  Reader reader(bytes);
  std::uint32_t marker = 0;
  FrameHead head{};
  const bool whole = reader.get(marker) && reader.get(head.checksum) && reader.get(head.length) &&
                     reader.get(head.block);
  if (!whole || marker != kFrameMarker) return std::nullopt;
  return head;
}

bool is_whole(const FrameHead& head, std::string_view payload) {
  std::uint32_t checksum = core::crc32c(&head.length, sizeof head.length);
  checksum = core::crc32c(&head.block, sizeof head.block, checksum);
  return payload.size() == head.length &&
         core::crc32c(payload.data(), payload.size(), checksum) == head.checksum;
}

std::optional<FrameSummary> decode_summary(const JournalHeader& header, std::int64_t index,
                                           std::string_view payload) {
  FrameSummary summary;
  std::vector<Status> status;
  Reader reader(payload);
  if (!get_beginning(reader, header, index, summary.times, status)) return std::nullopt;
  for (const Status one : status) {
    summary.ok += one == Status::ok;
    summary.failed += one == Status::failed;
    summary.skipped += one == Status::skipped;
    summary.not_run += one == Status::not_run;
  }
  return summary;
}

std::optional<Block> decode_block(const JournalHeader& header, std::int64_t index,
                                  std::string_view payload) {
  Reader reader(payload);
  BlockTimes times;
  std::vector<Status> status;
  if (!get_beginning(reader, header, index, times, status)) return std::nullopt;
  Block block(header.first_of(index), 0, 0, false);
  block.count = header.count_of(index);
  block.status = std::move(status);
  if (!reader.get_all(block.values, static_cast<std::size_t>(header.columns * block.count))) {
    return std::nullopt;
  }
  block.failures.resize(static_cast<std::size_t>(block.count));
  for (std::int64_t i = 0; i < block.count; ++i) {
    if (block.status[i] == Status::failed && !reader.get_text(block.failures[i])) {
      return std::nullopt;
    }
  }
  if (header.traces) {
    block.traces.resize(static_cast<std::size_t>(block.count));
    for (Trace& trace : block.traces) {
      if (!get_trace(reader, trace)) return std::nullopt;
    }
  }
  if (!reader.at_end()) return std::nullopt;
  return block;
}

}  // namespace millstudy::sweep
