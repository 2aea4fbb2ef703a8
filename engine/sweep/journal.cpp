// SPDX-License-Identifier: MIT
#include "sweep/journal.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

#include "core/file_at.h"
#include "core/resource_error.h"
#include "sweep/journal_file.h"
#include "sweep/journal_scan.h"

namespace millstudy::sweep {

Journal::Journal(std::string path, const JournalHeader& header, const std::string& owner)
    : path_(std::move(path)) {
  do {
    if (fd_ >= 0) ::close(fd_);  // removed by its last writer before it was ours
    fd_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd_ < 0) refuse_journal(path_, fmt::format("cannot be written: {}", std::strerror(errno)));
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
  refuse_journal(path_,
                 fmt::format("is being written by {}", other.empty() ? "another process" : other));
}

void Journal::open(const JournalHeader& header, const std::string& owner) {
  const auto write = [&](std::uint64_t place, std::string_view bytes) {
    const int error = core::write_at(fd_, place, bytes);
    if (error != 0) {
      throw core::ResourceError(
          fmt::format("{}: cannot be written: {}", path_, std::strerror(error)));
    }
  };
  // A beginning that was cut short before the magic was written holds nothing.
  const std::string beginning = core::read_at(fd_, 0, kJournalMagic.size());
  const bool empty = kJournalMagic.starts_with(beginning) && beginning != kJournalMagic;
  if (empty || beginning == std::string(kJournalMagic.size(), '\0')) {
    // The magic comes last: a beginning that was cut short is not taken for a journal.
    const std::string bytes = encode_header(header);
    write(kJournalMagic.size(), std::string_view(bytes).substr(kJournalMagic.size()));
    write(0, kJournalMagic);
    contents_.header = header;
    contents_.end = contents_.size = bytes.size();
  } else {
    contents_ = scan_journal(fd_, path_);
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
  const auto head = decode_head(core::read_at(fd_, entry.place - kFrameHead, kFrameHead));
  const std::string payload = core::read_at(fd_, entry.place, entry.length);
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
  const int error = core::write_at(fd_, contents_.end, frame);
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
  const std::int64_t end = header.first + header.count;
  sink.leave_out(0, header.first);
  for (std::int64_t block = 0; block < header.blocks(); ++block) sink.write(journal.read(block));
  sink.leave_out(end, header.points - end);
}

}  // namespace millstudy::sweep
