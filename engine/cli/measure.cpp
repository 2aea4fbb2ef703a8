// SPDX-License-Identifier: MIT
#include "cli/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace millstudy::cli {
namespace {

/// A step that visits all of so many strata in turn, and spreads any number of the first evenly.
std::int64_t spreading_step(std::int64_t strata) {
  constexpr double kGoldenPart = 0.6180339887498949;
  auto step = static_cast<std::int64_t>(std::ceil(kGoldenPart * static_cast<double>(strata)));
  while (std::gcd(step, strata) != 1) ++step;
  return step;
}

}  // namespace

Estimate measure_blocks(const sweep::EvaluateBlock& evaluate, const sweep::Layout& layout,
                        std::int64_t block_size, std::int64_t most_blocks, double budget) {
  const std::int64_t blocks = (layout.points() + block_size - 1) / block_size;
  const std::int64_t tried = std::min(blocks, most_blocks);
  const std::int64_t step = spreading_step(tried);
  constexpr double kMostSamples = 64e6 / 20.0;  // 64 MB, of five floats each
  Estimate estimate;
  double samples = 0.0;
  std::int64_t skipped = 0;
  double seconds = 0.0;
  const auto start = std::chrono::steady_clock::now();
  for (std::int64_t i = 0; i < tried && (i == 0 || seconds < budget); ++i) {
    const std::int64_t stratum = step * i % tried;
    const std::int64_t first = (2 * stratum + 1) * blocks / (2 * tried) * block_size;
    sweep::Block block(first, std::min(block_size, layout.points() - first), layout.columns.size(),
                       layout.traces);
    evaluate(block);
    estimate.measured_points += block.count;
    skipped += std::count(block.status.begin(), block.status.end(), sweep::Status::skipped);
    for (const sweep::Trace& trace : block.traces) {
      samples += static_cast<double>(trace.time.size());
    }
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (samples > kMostSamples && i > 0) {
      for (sweep::Trace& trace : block.traces) trace = {};
    }
    estimate.blocks.push_back(std::move(block));
  }
  const auto measured = static_cast<double>(estimate.measured_points);
  estimate.seconds_per_point = seconds / measured;
  estimate.trace_samples_per_point = samples / measured;
  estimate.skipped_part = static_cast<double>(skipped) / measured;
  return estimate;
}

Estimate measure(const study::Study& study, const sweep::Layout& layout) {
  constexpr double kBudget = 1.0;  // [s]
  constexpr std::int64_t kMostBlocks = 16;
  const sweep::EvaluateBlock evaluate = study::block_evaluator(study);
  const Estimate single = measure_blocks(evaluate, layout, 1, kMostBlocks, kBudget);
  const auto affordable = static_cast<std::int64_t>(
      kBudget / (static_cast<double>(kMostBlocks) * single.seconds_per_point));
  const std::int64_t size =
      std::clamp<std::int64_t>(affordable, 1, sweep::default_block_size(layout));
  if (size > 1) return measure_blocks(evaluate, layout, size, kMostBlocks, kBudget);
  // Single points may differ much: more of them, unless all are measured or one takes too long.
  const bool enough = single.measured_points == layout.points();
  if (enough || single.seconds_per_point > kBudget) return single;
  return measure_blocks(evaluate, layout, 1, 16 * kMostBlocks, 2.0 * kBudget);
}

double memory_bytes(const sweep::Layout& layout, double trace_samples_per_point, int threads,
                    std::int64_t block_size) {
  // Measured: within 30 % of the peak of ready-made studies, and of 1 to 4 threads with traces of
  // 4 MB in blocks of 1 and 8.
  constexpr double kProgram = 30e6;
  constexpr double kThread = 0.5e6;         // what its stack and the allocator take
  constexpr double kChunk = 8.0 * 65536.0;  // at most one a column is held back
  const auto columns = static_cast<double>(layout.columns.size());
  const double trace = 20.0 * trace_samples_per_point;
  const double chunk = std::min(kChunk, 8.0 * static_cast<double>(layout.points()));
  const double block = static_cast<double>(block_size) * (8.0 * columns + trace);
  const double frame = 2.5 * block;  // one at a time, and the space in which it grew
  return kProgram + chunk * columns + frame + threads * (kThread + 1.3 * block + 3.0 * trace);
}

}  // namespace millstudy::cli
