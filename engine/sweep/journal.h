// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sweep/block.h"
#include "sweep/journal_format.h"
#include "sweep/runner.h"

namespace millstudy::sweep {

/// Where a block stands in a journal, and what became of its points.
struct JournalEntry {
  std::uint64_t place = 0;   ///< of the payload; 0: the block is not there
  std::uint64_t length = 0;  ///< of the payload
  float seconds = 0.0F;      ///< that it took on its thread
  std::int32_t ok = 0;
  std::int32_t failed = 0;
  std::int32_t skipped = 0;
  std::int32_t not_run = 0;  ///< it was interrupted
};

/// What a journal holds, as far as it is whole.
struct JournalContents {
  JournalHeader header;
  std::string owner;                  ///< who computes it, or did last
  std::vector<JournalEntry> entries;  ///< of the blocks up to the last that is there
  std::int64_t ok = 0;
  std::int64_t failed = 0;
  std::int64_t skipped = 0;
  std::uint64_t end = 0;         ///< of the last whole frame
  std::uint64_t size = 0;        ///< of the file
  std::int64_t damaged = 0;      ///< stretches before the end that are no frames
  double seconds = 0.0;          ///< of all sessions together
  std::uint32_t sessions = 0;    ///< so far
  double session_seconds = 0.0;  ///< of the last one
  std::int64_t session_points = 0;

  std::int64_t done() const { return ok + failed + skipped; }
  /// The entry of a block; one that is not there has place 0.
  JournalEntry entry(std::int64_t block) const;
};

/// Reads a journal while it may be written: what is not whole is left out.
///
/// 1 GB/s and more, in memory for one block and 40 bytes for each.
/// @return nullopt if there is no such file
/// @throws core::InputError if it is no journal, of another version, or its header is damaged
std::optional<JournalContents> read_journal(const std::string& path);

/// The only copy of a running sweep: finished blocks are appended in any order and survive whatever
/// happens to the process at once, and to the machine after two seconds.
///
/// One writer at a time. A block that is appended again replaces the one before. Without any block
/// the file goes with the object.
class Journal {
 public:
  /// Creates the file, or goes on with the one that is there: a torn end is cut off.
  /// @param owner  who computes: "process 123 on host"
  /// @throws core::InputError if the file cannot be written or another process writes it, and for
  /// what read_journal() finds; core::ResourceError if the disk is full
  Journal(std::string path, const JournalHeader& header, const std::string& owner);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }
  const JournalContents& contents() const { return contents_; }
  /// Blocks that are not there or were interrupted, ascending.
  std::vector<std::int64_t> pending() const;

  /// A block as it is in the journal; without any status if it is not there.
  /// @throws core::ResourceError if it can no longer be read
  Block read(std::int64_t index) const;

  /// Durable no later than two seconds after.
  /// @throws core::ResourceError if it cannot be written; nothing of it is in the file then, and
  /// the same call may succeed later
  void append(const Block& block, const BlockTimes& times);

  /// Makes all of it durable. @throws core::ResourceError
  void sync();
  /// The result is complete: the file is no longer needed.
  void remove();
  /// True if another process writes the file.
  static bool is_taken(const std::string& path);

 private:
  void take() const;
  void open(const JournalHeader& header, const std::string& owner);
  void sync_in_the_background();

  std::string path_;
  int fd_ = -1;
  JournalContents contents_;
  mutable std::mutex mutex_;  // of what follows
  bool dirty_ = false;
  bool closing_ = false;
  int sync_error_ = 0;
  std::condition_variable wake_;
  std::thread syncer_;
};

/// What of a journal is left to do.
Remainder remainder(const Journal& journal);

/// Hands all points of the study to a sink in order; those that the journal is not of are not run.
/// @throws core::ResourceError if a block can no longer be read
void replay(const Journal& journal, Sink& sink);

}  // namespace millstudy::sweep
