// SPDX-License-Identifier: MIT
#include "sweep/journal_scan.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include "core/file_at.h"
#include "sweep/journal_file.h"

namespace millstudy::sweep {
namespace {

/// Blocks are started in order: one cannot be further ahead of those that are there.
constexpr std::uint64_t kMostAhead = 1 << 20;

/// Goes through the frames of a file.
class Scan {
 public:
  Scan(int fd, JournalContents& contents) : fd_(fd), contents_(contents) {}

  void run(std::uint64_t place) {
    contents_.end = place;
    effort_left_ = 16 * contents_.size + (1 << 20);
    while (place < contents_.size) {
      if (const std::uint64_t next = frame_at(place)) {
        place = contents_.end = next;
        continue;
      }
      const std::uint64_t found = next_frame(place + 1);
      if (found == 0) return;
      ++contents_.damaged;
      place = found;
    }
  }

 private:
  /// Takes the frame at a place. @return where the next begins; 0 if there is none here
  std::uint64_t frame_at(std::uint64_t place) {
    const auto head = decode_head(core::read_at(fd_, place, kFrameHead));
    if (!head || head->length > contents_.size - place - kFrameHead) return 0;
    if (head->block >= contents_.entries.size() + kMostAhead) return 0;
    if (head->length > effort_left_) return 0;
    const std::string payload = core::read_at(fd_, place + kFrameHead, head->length);
    if (!is_whole(*head, payload)) {
      effort_left_ -= head->length;  // of false beginnings
      return 0;
    }
    const auto index = static_cast<std::int64_t>(head->block);
    const auto summary = decode_summary(contents_.header, index, payload);
    if (!summary) return 0;
    add(index,
        {place + kFrameHead, head->length, static_cast<float>(summary->times.seconds),
         static_cast<std::int32_t>(summary->ok), static_cast<std::int32_t>(summary->failed),
         static_cast<std::int32_t>(summary->skipped), static_cast<std::int32_t>(summary->not_run)});
    add(*summary);
    return place + kFrameHead + head->length;
  }

  /// The first place from here on at which a whole frame begins; 0: none.
  std::uint64_t next_frame(std::uint64_t place) {
    constexpr std::uint64_t kWindow = 1 << 20;
    std::string marker(sizeof kFrameMarker, '\0');
    std::memcpy(marker.data(), &kFrameMarker, sizeof kFrameMarker);
    for (; place < contents_.size; place += kWindow) {
      const std::string window =
          core::read_at(fd_, place, std::min(kWindow + marker.size() - 1, contents_.size - place));
      for (std::size_t at = window.find(marker); at != std::string::npos;
           at = window.find(marker, at + 1)) {
        if (is_frame(place + at)) return place + at;
      }
    }
    return 0;
  }

  bool is_frame(std::uint64_t place) {
    const auto head = decode_head(core::read_at(fd_, place, kFrameHead));
    if (!head || head->length > contents_.size - place - kFrameHead) return false;
    if (head->length > effort_left_) return false;
    effort_left_ -= head->length;
    return is_whole(*head, core::read_at(fd_, place + kFrameHead, head->length));
  }

  void add(std::int64_t index, const JournalEntry& entry) {
    auto& entries = contents_.entries;
    if (static_cast<std::size_t>(index) >= entries.size()) entries.resize(index + 1);
    const JournalEntry& before = entries[index];
    contents_.ok += entry.ok - before.ok;
    contents_.failed += entry.failed - before.failed;
    contents_.skipped += entry.skipped - before.skipped;
    entries[index] = entry;
  }

  void add(const FrameSummary& summary) {
    const BlockTimes& times = summary.times;
    if (times.session + 1 != contents_.sessions) {
      contents_.sessions = times.session + 1;
      contents_.session_seconds = 0.0;
      contents_.session_points = 0;
    }
    const double before = contents_.session_seconds;
    contents_.session_seconds = std::max(before, times.elapsed);
    contents_.seconds += contents_.session_seconds - before;
    contents_.session_points += summary.ok + summary.failed + summary.skipped;
  }

  int fd_;
  JournalContents& contents_;
  std::uint64_t effort_left_ = 0;  // bytes that are looked at in vain, or a bad file takes for ever
};

}  // namespace

JournalContents scan_journal(int fd, const std::string& path) {
  JournalContents contents;
  contents.size = size_of(fd);
  const std::string beginning = core::read_at(fd, 0, kHeaderPlace);
  if (!beginning.starts_with(kJournalMagic)) refuse_journal(path, "is not a journal of a run");
  std::uint32_t version = 0, length = 0;
  if (beginning.size() == kHeaderPlace) {
    std::memcpy(&version, beginning.data() + 8, sizeof version);
    std::memcpy(&length, beginning.data() + 12, sizeof length);
    if (version != kJournalVersion) {
      refuse_journal(
          path, fmt::format("is a journal of version {}, this program writes {}: finish it with "
                            "the program that began it, or start anew with --fresh",
                            version, kJournalVersion));
    }
  }
  const std::uint64_t whole = kHeaderPlace + std::uint64_t{length} + sizeof(std::uint32_t);
  const auto header =
      whole <= contents.size ? decode_header(core::read_at(fd, 0, whole)) : std::nullopt;
  if (!header) {
    refuse_journal(path,
                   "has a damaged beginning, no point of it can be told: start anew with --fresh");
  }
  contents.header = *header;
  contents.owner = owner_in(fd);
  Scan(fd, contents).run(whole);
  return contents;
}

JournalEntry JournalContents::entry(std::int64_t block) const {
  return static_cast<std::size_t>(block) < entries.size() ? entries[block] : JournalEntry{};
}

std::optional<JournalContents> read_journal(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0 && (errno == ENOENT || errno == ENOTDIR)) return std::nullopt;
  if (fd < 0) refuse_journal(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  try {
    JournalContents contents = scan_journal(fd, path);
    ::close(fd);
    return contents;
  } catch (...) {
    ::close(fd);
    throw;
  }
}

}  // namespace millstudy::sweep
