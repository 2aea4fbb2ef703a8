// SPDX-License-Identifier: MIT
#include "sweep/runner.h"

#include <algorithm>
#include <chrono>

#include "core/ordered_parallel.h"

namespace millstudy::sweep {
namespace {

void count_points(const Block& block, Progress& progress) {
  for (const Status status : block.status) {
    progress.ok += status == Status::ok;
    progress.failed += status == Status::failed;
    progress.skipped += status == Status::skipped;
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Loop {
  const EvaluateBlock& evaluate;
  Sink& sink;
  const RunOptions& options;
  Progress progress;

  template <class BlockAt>
  Progress run(std::int64_t blocks, const BlockAt& block_at, core::Order order) {
    const auto start = std::chrono::steady_clock::now();
    static const std::atomic<bool> never = false;
    const auto compute = [&](std::int64_t index) {
      Block block = block_at(index);
      const auto begin = std::chrono::steady_clock::now();
      evaluate(block);
      block.seconds = seconds_since(begin);
      return block;
    };
    const auto consume = [&](std::int64_t, Block&& block) {
      progress.seconds = seconds_since(start);
      sink.write(block);
      count_points(block, progress);
      if (options.progress) options.progress(progress);
    };
    core::ordered_parallel(blocks, options.threads, options.stop ? *options.stop : never, compute,
                           consume, order);
    progress.seconds = seconds_since(start);
    return progress;
  }
};

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

Progress run_blocks(const Layout& layout, const EvaluateBlock& evaluate, Sink& sink,
                    const RunOptions& options) {
  const std::int64_t size =
      options.block_size > 0 ? options.block_size : default_block_size(layout);
  const std::int64_t blocks = (layout.points() + size - 1) / size;
  const auto block_at = [&](std::int64_t index) {
    const std::int64_t first = index * size;
    return Block(first, std::min(size, layout.points() - first), layout.columns.size(),
                 layout.traces);
  };
  Progress progress;
  progress.points = layout.points();
  return Loop{evaluate, sink, options, progress}.run(blocks, block_at, core::Order::of_items);
}

Progress run_blocks(const EvaluateBlock& evaluate, Sink& sink, const Remainder& remainder,
                    const RunOptions& options) {
  Progress progress = remainder.done;
  progress.points = remainder.points;
  progress.before = progress.done();
  const auto block_at = [&](std::int64_t i) { return remainder.begin(remainder.blocks[i]); };
  return Loop{evaluate, sink, options, progress}.run(
      static_cast<std::int64_t>(remainder.blocks.size()), block_at, core::Order::of_results);
}

}  // namespace millstudy::sweep
