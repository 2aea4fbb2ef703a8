// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::sweep {

/// How far a run has come.
struct Progress {
  std::int64_t points = 0;  ///< of the whole study
  std::int64_t ok = 0;
  std::int64_t failed = 0;
  std::int64_t skipped = 0;
  double seconds = 0.0;  ///< since the start

  std::int64_t before = 0;  ///< done in earlier sessions, and not in these seconds

  std::int64_t done() const { return ok + failed + skipped; }
};

/// Blocks of a study that are left to do, of all sessions together.
struct Remainder {
  std::int64_t points = 0;           ///< of all its blocks
  std::vector<std::int64_t> blocks;  ///< to compute, ascending
  Progress done;                     ///< what the others have
  /// A block as it is so far: points that have a status keep it.
  std::function<Block(std::int64_t block)> begin;
};

struct RunOptions {
  int threads = 0;                                     ///< 0: all
  const std::atomic<bool>* stop = nullptr;             ///< set from outside to end early
  std::function<void(const Progress&)> progress = {};  ///< called after every block, one at a time
};

/// Fills one block: every point that has no status yet gets one, and its values or its failure.
/// Called concurrently.
using EvaluateBlock = std::function<void(Block&)>;

/// Points per block: small enough to share evenly among the threads and, with traces, to hold in
/// memory; large enough that scheduling costs nothing. Results do not depend on it.
///
/// @param seconds_per_point  where it is known: a block of slow points must not take long, or
/// nobody
///                           sees progress and the last blocks end at different times
std::int64_t default_block_size(const Layout& layout, double seconds_per_point = 0.0);

/// The blocks of a run on their way: handed out one after another, taken in as they come. Every
/// function may be called from any thread.
class BlockDesk {
 public:
  BlockDesk(const Remainder& remainder, Sink& sink, const RunOptions& options);

  /// The next block to compute; nullopt if there are no more or the run is to end.
  std::optional<std::int64_t> next();
  /// A computed block goes to the sink and is counted. @throws what the sink throws
  void take(const Block& block);

  /// From now on next() gives none.
  void stop() { stopped_ = true; }
  bool stopped() const;
  Progress progress() const;

 private:
  const Remainder& remainder_;
  Sink& sink_;
  const RunOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<bool> stopped_ = false;
  mutable std::mutex mutex_;  // of what follows, and of the sink
  std::size_t at_ = 0;
  Progress progress_;
};

/// The block with its computing time.
Block computed(const EvaluateBlock& evaluate, Block block);

/// Computes blocks of a desk in parallel until it has no more.
void compute_blocks(BlockDesk& desk, const EvaluateBlock& evaluate, const Remainder& remainder,
                    int threads);

/// Computes what is left of a study and hands blocks to the sink as soon as they are there, in any
/// order; where it is stopped, those in flight with the points they have. Does not call
/// Sink::finish: an interrupted run (progress.done() < points) is the caller's to judge.
///
/// The values do not depend on threads or block size; memory is bounded by the blocks in flight.
Progress run_blocks(const EvaluateBlock& evaluate, Sink& sink, const Remainder& remainder,
                    const RunOptions& options);

}  // namespace millstudy::sweep
