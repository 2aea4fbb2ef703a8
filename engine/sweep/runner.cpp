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
  const auto start = std::chrono::steady_clock::now();
  static const std::atomic<bool> never = false;
  Progress progress;
  progress.points = layout.points();
  const std::int64_t size =
      options.block_size > 0 ? options.block_size : default_block_size(layout);
  const std::int64_t blocks = (progress.points + size - 1) / size;

  const auto compute = [&](std::int64_t index) {
    const std::int64_t first = index * size;
    Block block(first, std::min(size, progress.points - first), layout.columns.size(),
                layout.traces);
    evaluate(block);
    return block;
  };
  const auto consume = [&](std::int64_t, Block&& block) {
    sink.write(block);
    count_points(block, progress);
    progress.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (options.progress) options.progress(progress);
  };
  core::ordered_parallel(blocks, options.threads, options.stop ? *options.stop : never, compute,
                         consume);
  return progress;
}

}  // namespace millstudy::sweep
