// SPDX-License-Identifier: MIT
#include "io/write_behind.h"

#include <fcntl.h>
#include <utility>

#include "core/file_at.h"

namespace millstudy::io {
namespace {

constexpr std::size_t kBatch = 2 << 20;
/// The disk is told to begin after so many bytes: else it stands still until all waits for it at
/// the end.
constexpr std::size_t kSent = 32 << 20;

}  // namespace

void WriteBehind::Batch::add(std::uint64_t place, std::string_view more) {
  bytes.append(more);  // within what was reserved
  const bool goes_on = !pieces.empty() && pieces.back().place + pieces.back().size == place;
  if (goes_on) {
    pieces.back().size += more.size();
  } else {
    pieces.push_back({place, more.size()});
  }
}

void WriteBehind::Batch::clear() {
  pieces.clear();
  bytes.clear();
}

WriteBehind::WriteBehind(int fd) : fd_(fd) {
  waiting_.bytes.reserve(kBatch);
  writing_.bytes.reserve(kBatch);
  writer_ = std::thread([this] { write_batches(); });
}

WriteBehind::~WriteBehind() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  writer_.join();
}

int WriteBehind::write(std::uint64_t place, std::string_view bytes) {
  while (!bytes.empty()) {
    const std::string_view part = bytes.substr(0, kBatch);
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return waiting_.bytes.size() + part.size() <= kBatch; });
      if (error_ != 0) return error_;
      waiting_.add(place, part);
    }
    changed_.notify_all();
    place += part.size();
    bytes.remove_prefix(part.size());
  }
  return 0;
}

int WriteBehind::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.empty() && !is_writing_; });
  return error_;
}

void WriteBehind::write_batches() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    std::swap(waiting_, writing_);
    is_writing_ = true;
    int error = error_;
    lock.unlock();
    changed_.notify_all();
    if (error == 0) error = write_out();
    writing_.clear();
    lock.lock();
    error_ = error;
    is_writing_ = false;
    changed_.notify_all();
  }
}

int WriteBehind::write_out() {
  std::string_view rest = writing_.bytes;
  for (const Piece& piece : writing_.pieces) {
    const int error = core::write_at(fd_, piece.place, rest.substr(0, piece.size));
    if (error != 0) return error;
    rest.remove_prefix(piece.size);
  }
  unsent_ += writing_.bytes.size();
  if (unsent_ >= kSent) {
    ::sync_file_range(fd_, 0, 0, SYNC_FILE_RANGE_WRITE);  // only a hint
    unsent_ = 0;
  }
  return 0;
}

}  // namespace millstudy::io
