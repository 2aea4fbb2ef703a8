// SPDX-License-Identifier: MIT
#include "sweep/runner.h"

#include <algorithm>

#include "core/parallel_items.h"

namespace millstudy::sweep {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::int64_t default_block_size(const Layout& layout, double seconds_per_point) {
  constexpr std::int64_t kFewestBlocks = 512;  // so that the last blocks end at about the same time
  constexpr double kLongestBlock = 0.25;       // [s]
  std::int64_t largest = layout.traces ? 8 : 256;
  if (seconds_per_point * static_cast<double>(largest) > kLongestBlock) {
    largest =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(kLongestBlock / seconds_per_point));
  }
  return std::clamp<std::int64_t>(layout.points() / kFewestBlocks, 1, largest);
}

BlockDesk::BlockDesk(const Remainder& remainder, Sink& sink, const RunOptions& options)
    : remainder_(remainder), sink_(sink), options_(options), progress_(remainder.done) {
  progress_.points = remainder.points;
  progress_.before = progress_.done();
}

std::optional<std::int64_t> BlockDesk::next() {
  const std::lock_guard lock(mutex_);
  if (stopped() || at_ == remainder_.blocks.size()) return std::nullopt;
  return remainder_.blocks[at_++];
}

void BlockDesk::take(const Block& block) {
  const std::lock_guard lock(mutex_);
  progress_.seconds = seconds_since(start_);
  sink_.write(block);
  for (const Status status : block.status) {
    progress_.ok += status == Status::ok;
    progress_.failed += status == Status::failed;
    progress_.skipped += status == Status::skipped;
  }
  if (options_.progress) options_.progress(progress_);
}

bool BlockDesk::stopped() const {
  return stopped_ || (options_.stop && options_.stop->load(std::memory_order_relaxed));
}

Progress BlockDesk::progress() const {
  const std::lock_guard lock(mutex_);
  Progress now = progress_;
  now.seconds = seconds_since(start_);
  return now;
}

Block computed(const EvaluateBlock& evaluate, Block block) {
  const auto begin = std::chrono::steady_clock::now();
  evaluate(block);
  block.seconds = seconds_since(begin);
  return block;
}

void compute_blocks(BlockDesk& desk, const EvaluateBlock& evaluate, const Remainder& remainder,
                    int threads) {
  core::parallel_items(
      [&] { return desk.next(); }, threads,
      [&](std::int64_t block) { return computed(evaluate, remainder.begin(block)); },
      [&](const Block& block) { desk.take(block); });
}

Progress run_blocks(const EvaluateBlock& evaluate, Sink& sink, const Remainder& remainder,
                    const RunOptions& options) {
  BlockDesk desk(remainder, sink, options);
  compute_blocks(desk, evaluate, remainder, options.threads);
  return desk.progress();
}

}  // namespace millstudy::sweep
