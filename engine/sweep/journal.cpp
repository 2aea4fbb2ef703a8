// SPDX-License-Identifier: MIT
#include "sweep/journal.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "core/error.h"
#include "core/resource_error.h"

namespace millstudy::sweep {
namespace {

/// Blocks are started in order: one cannot be further ahead of those that are there.
constexpr std::uint64_t kMostAhead = 1 << 20;

/// Everything from a place on, or what the file has of it.
std::string read_at(int fd, std::uint64_t place, std::uint64_t size) {
  std::string bytes(size, '\0');
  std::size_t have = 0;
  while (have < size) {
    const ssize_t got =
        ::pread(fd, bytes.data() + have, size - have, static_cast<off_t>(place + have));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    have += static_cast<std::size_t>(got);
  }
  bytes.resize(have);
  return bytes;
}

/// @return 0, or why not
int write_at(int fd, std::uint64_t place, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::pwrite(fd, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return errno;
    if (put == 0) return ENOSPC;
    place += static_cast<std::uint64_t>(put);
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  return 0;
}

std::uint64_t size_of(int fd) {
  struct stat status {};
  return ::fstat(fd, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::string owner_in(int fd) {
  const std::string bytes = read_at(fd, kOwnerPlace, kOwnerSize);
  return bytes.substr(0, bytes.find('\0'));
}

/// True if the path still names the open file.
bool still_names(const std::string& path, int fd) {
  struct stat named {};
  struct stat opened {};
  return ::stat(path.c_str(), &named) == 0 && ::fstat(fd, &opened) == 0 &&
         named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw core::InputError({path, 0}, why);
}

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
    const auto head = decode_head(read_at(fd_, place, kFrameHead));
    if (!head || head->length > contents_.size - place - kFrameHead) return 0;
    if (head->block >= contents_.entries.size() + kMostAhead) return 0;
    if (head->length > effort_left_) return 0;
    const std::string payload = read_at(fd_, place + kFrameHead, head->length);
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
      const std::string window = read_at(fd_, place, kWindow + marker.size() - 1);
      for (std::size_t at = window.find(marker); at != std::string::npos;
           at = window.find(marker, at + 1)) {
        if (is_frame(place + at)) return place + at;
      }
    }
    return 0;
  }

  bool is_frame(std::uint64_t place) {
    const auto head = decode_head(read_at(fd_, place, kFrameHead));
    if (!head || head->length > contents_.size - place - kFrameHead) return false;
    if (head->length > effort_left_) return false;
    effort_left_ -= head->length;
    return is_whole(*head, read_at(fd_, place + kFrameHead, head->length));
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

JournalContents contents_of(int fd, const std::string& path) {
  JournalContents contents;
  contents.size = size_of(fd);
  const std::string beginning = read_at(fd, 0, kHeaderPlace);
  if (!beginning.starts_with(kJournalMagic)) refuse(path, "is not a journal of a run");
  std::uint32_t version = 0, length = 0;
  if (beginning.size() == kHeaderPlace) {
    std::memcpy(&version, beginning.data() + 8, sizeof version);
    std::memcpy(&length, beginning.data() + 12, sizeof length);
    if (version != kJournalVersion) {
      refuse(path, fmt::format("is a journal of version {}, this program writes {}: finish it with "
                               "the program that began it, or start anew with --fresh",
                               version, kJournalVersion));
    }
  }
  const std::uint64_t whole = kHeaderPlace + std::uint64_t{length} + sizeof(std::uint32_t);
  const auto header = whole <= contents.size ? decode_header(read_at(fd, 0, whole)) : std::nullopt;
  if (!header) {
    refuse(path, "has a damaged beginning, no point of it can be told: start anew with --fresh");
  }
  contents.header = *header;
  contents.owner = owner_in(fd);
  Scan(fd, contents).run(whole);
  return contents;
}

}  // namespace

JournalEntry JournalContents::entry(std::int64_t block) const {
  return static_cast<std::size_t>(block) < entries.size() ? entries[block] : JournalEntry{};
}

std::optional<JournalContents> read_journal(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0 && (errno == ENOENT || errno == ENOTDIR)) return std::nullopt;
  if (fd < 0) refuse(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  try {
    JournalContents contents = contents_of(fd, path);
    ::close(fd);
    return contents;
  } catch (...) {
    ::close(fd);
    throw;
  }
}

Journal::Journal(std::string path, const JournalHeader& header, const std::string& owner)
    : path_(std::move(path)) {
  do {
    if (fd_ >= 0) ::close(fd_);  // removed by its last writer before it was ours
    fd_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd_ < 0) refuse(path_, fmt::format("cannot be written: {}", std::strerror(errno)));
    take();
  } while (!still_names(path_, fd_));
  try {
    open(header, owner);
  } catch (...) {
    ::close(fd_);
    throw;
  }
  syncer_ = std::thread([this] { sync_in_the_background(); });
}

void Journal::take() const {
  // A file system without locks (ENOLCK, EINVAL) is no reason to refuse.
  if (::flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  const std::string other = owner_in(fd_);
  ::close(fd_);
  refuse(path_, fmt::format("is being written by {}", other.empty() ? "another process" : other));
}

void Journal::open(const JournalHeader& header, const std::string& owner) {
  const auto write = [&](std::uint64_t place, std::string_view bytes) {
    const int error = write_at(fd_, place, bytes);
    if (error != 0) {
      throw core::ResourceError(
          fmt::format("{}: cannot be written: {}", path_, std::strerror(error)));
    }
  };
  // A beginning that was cut short before the magic was written holds nothing.
  const std::string beginning = read_at(fd_, 0, kJournalMagic.size());
  const bool empty = kJournalMagic.starts_with(beginning) && beginning != kJournalMagic;
  if (empty || beginning == std::string(kJournalMagic.size(), '\0')) {
    // The magic comes last: a beginning that was cut short is not taken for a journal.
    const std::string bytes = encode_header(header);
    write(kJournalMagic.size(), std::string_view(bytes).substr(kJournalMagic.size()));
    write(0, kJournalMagic);
    contents_.header = header;
    contents_.end = contents_.size = bytes.size();
  } else {
    contents_ = contents_of(fd_, path_);
    if (contents_.end < contents_.size &&
        ::ftruncate(fd_, static_cast<off_t>(contents_.end)) != 0) {
      throw core::ResourceError(
          fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
    }
  }
  std::string padded = owner.substr(0, kOwnerSize - 1);
  padded.resize(kOwnerSize, '\0');
  write(kOwnerPlace, padded);
  dirty_ = true;
}

Journal::~Journal() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_all();
  if (syncer_.joinable()) syncer_.join();
  ::fsync(fd_);
  if (contents_.entries.empty()) ::unlink(path_.c_str());
  ::close(fd_);
}

std::vector<std::int64_t> Journal::pending() const {
  std::vector<std::int64_t> blocks;
  for (std::int64_t block = 0; block < contents_.header.blocks(); ++block) {
    const JournalEntry entry = contents_.entry(block);
    if (entry.place == 0 || entry.not_run > 0) blocks.push_back(block);
  }
  return blocks;
}

Block Journal::read(std::int64_t index) const {
  const JournalHeader& header = contents_.header;
  JournalEntry entry;
  {
    const std::lock_guard lock(mutex_);
    entry = contents_.entry(index);
  }
  if (entry.place == 0) {
    return {header.first_of(index), header.count_of(index),
            static_cast<std::size_t>(header.columns), header.traces};
  }
  const auto head = decode_head(read_at(fd_, entry.place - kFrameHead, kFrameHead));
  const std::string payload = read_at(fd_, entry.place, entry.length);
  if (head && is_whole(*head, payload)) {
    if (auto block = decode_block(header, index, payload)) return std::move(*block);
  }
  throw core::ResourceError(
      fmt::format("{}: block {} can no longer be read; run again", path_, index));
}

void Journal::append(const Block& block, const BlockTimes& times) {
  const std::int64_t index = (block.first - contents_.header.first) / contents_.header.block_size;
  const std::string frame = encode_frame(index, block, times);
  {
    const std::lock_guard lock(mutex_);
    if (sync_error_ != 0) {
      throw core::ResourceError(fmt::format("{}: cannot be written: {}", path_,
                                            std::strerror(std::exchange(sync_error_, 0))));
    }
  }
  const int error = write_at(fd_, contents_.end, frame);
  if (error != 0) {
    // What is torn would be found at the next start; the space may be needed at once.
    if (::ftruncate(fd_, static_cast<off_t>(contents_.end)) != 0) { /* stays torn */
    }
    throw core::ResourceError(
        fmt::format("{}: cannot be written: {}", path_, std::strerror(error)));
  }
  JournalEntry entry{contents_.end + kFrameHead, frame.size() - kFrameHead,
                     static_cast<float>(times.seconds)};
  for (const Status status : block.status) {
    entry.ok += status == Status::ok;
    entry.failed += status == Status::failed;
    entry.skipped += status == Status::skipped;
    entry.not_run += status == Status::not_run;
  }
  const std::lock_guard lock(mutex_);
  contents_.end += frame.size();
  contents_.size = contents_.end;
  auto& entries = contents_.entries;
  if (static_cast<std::size_t>(index) >= entries.size()) entries.resize(index + 1);
  contents_.ok += entry.ok - entries[index].ok;
  contents_.failed += entry.failed - entries[index].failed;
  contents_.skipped += entry.skipped - entries[index].skipped;
  entries[index] = entry;
  dirty_ = true;
}

void Journal::sync() {
  {
    const std::lock_guard lock(mutex_);
    dirty_ = false;
  }
  if (::fsync(fd_) == 0) return;
  throw core::ResourceError(fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
}

void Journal::sync_in_the_background() {
  constexpr std::chrono::milliseconds kPause(1000);
  std::unique_lock lock(mutex_);
  while (!closing_) {
    wake_.wait_for(lock, kPause);
    if (!dirty_ || closing_) continue;
    dirty_ = false;
    lock.unlock();
    const int error = ::fsync(fd_) == 0 ? 0 : errno;
    lock.lock();
    if (error != 0) sync_error_ = error;
  }
}

void Journal::remove() {
  ::unlink(path_.c_str());
  const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  const int fd = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

bool Journal::is_taken(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool taken = ::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(fd);
  return taken;
}

Remainder remainder(const Journal& journal) {
  const JournalContents& contents = journal.contents();
  Remainder left;
  left.first_point = contents.header.first;
  left.points = contents.header.count;
  left.blocks = journal.pending();
  left.done.ok = contents.ok;
  left.done.failed = contents.failed;
  left.done.skipped = contents.skipped;
  for (const std::int64_t block : left.blocks) {  // they are counted when they come
    const JournalEntry entry = contents.entry(block);
    left.done.ok -= entry.ok;
    left.done.failed -= entry.failed;
    left.done.skipped -= entry.skipped;
  }
  left.begin = [&journal](std::int64_t block) { return journal.read(block); };
  return left;
}

void replay(const Journal& journal, Sink& sink) {
  const JournalHeader& header = journal.contents().header;
  const auto not_run = [&](std::int64_t from, std::int64_t to) {
    constexpr std::int64_t kAtOnce = 1 << 16;
    for (std::int64_t first = from; first < to; first += kAtOnce) {
      sink.write({first, std::min(kAtOnce, to - first), static_cast<std::size_t>(header.columns),
                  header.traces});
    }
  };
  not_run(0, header.first);
  for (std::int64_t block = 0; block < header.blocks(); ++block) sink.write(journal.read(block));
  not_run(header.first + header.count, header.points);
}

}  // namespace millstudy::sweep
