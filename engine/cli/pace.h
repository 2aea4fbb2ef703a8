// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "cli/commands.h"
#include "sweep/layout.h"
#include "sweep/runner.h"

namespace millstudy::cli {

/// How a run goes about its points.
struct Pace {
  std::int64_t block_size = 1;
  int threads = 1;
};

/// Blocks that last a fraction of a second; smaller ones, and then fewer threads, until they fit
/// into the memory that the user allows.
/// @param fixed  size of the blocks of a journal that is there; 0: to be chosen
/// @throws core::InputError if not even one thread fits
Pace chosen_pace(const RunSettings& settings, const sweep::Layout& layout,
                 const sweep::EvaluateBlock& evaluate, int threads, std::int64_t fixed);

/// What goes beyond the limit is out of memory, and not the machine's trouble. @param bytes  0:
/// none
void limit_memory(std::uint64_t bytes, int threads);

}  // namespace millstudy::cli
