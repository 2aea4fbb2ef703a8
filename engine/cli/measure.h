// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "study/study.h"
#include "sweep/block.h"

namespace millstudy::cli {

/// What points of a study cost, by trying some.
struct Estimate {
  double seconds_per_point = 0.0;  ///< on one thread
  double trace_samples_per_point = 0.0;
  double skipped_part = 0.0;
  std::int64_t measured_points = 0;
  std::vector<sweep::Block> blocks;  ///< that were measured; without traces from 64 MB of them
};

/// Times blocks of one size spread evenly over the study, at most most_blocks of them, until the
/// budget is spent; at least one. What the budget leaves out is spread evenly, too.
///
/// @param budget  [s]; exceeded by the last block at most
Estimate measure_blocks(const sweep::EvaluateBlock& evaluate, const sweep::Layout& layout,
                        std::int64_t block_size, std::int64_t most_blocks, double budget);

/// Points one by one first, since nobody knows how slow they are; then, where they are fast, whole
/// blocks, in which points share work as they do in a run, and else more single points if there is
/// time for them.
Estimate measure(const study::Study& study, const sweep::Layout& layout);

/// Memory of a run [bytes]: one chunk a column in the writer, and the blocks in flight with the
/// frames that they become.
double memory_bytes(const sweep::Layout& layout, double trace_samples_per_point, int threads,
                    std::int64_t block_size);

}  // namespace millstudy::cli
