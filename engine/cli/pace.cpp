// SPDX-License-Identifier: MIT
#include "cli/pace.h"

#include <algorithm>
#include <fmt/core.h>
#include <sys/resource.h>

#include "cli/measure.h"
#include "cli/progress.h"
#include "core/error.h"

namespace millstudy::cli {

Pace chosen_pace(const RunSettings& settings, const sweep::Layout& layout,
                 const sweep::EvaluateBlock& evaluate, int threads, std::int64_t fixed) {
  Pace pace{fixed > 0 ? fixed : settings.block_size, threads};
  if (pace.block_size == 0 && sweep::default_block_size(layout) <= 1) pace.block_size = 1;
  if (pace.block_size > 0 && settings.memory == 0) return pace;
  const Estimate one = measure_blocks(evaluate, layout, 1, 1, 0.0);
  if (pace.block_size == 0) {
    pace.block_size = sweep::default_block_size(layout, one.seconds_per_point);
  }
  if (settings.memory == 0) return pace;
  const auto allowed = static_cast<double>(settings.memory);
  const auto needed = [&] {
    return memory_bytes(layout, one.trace_samples_per_point, pace.threads, pace.block_size);
  };
  while (needed() > allowed && fixed == 0 && pace.block_size > 1) pace.block_size /= 2;
  while (needed() > allowed && pace.threads > 1) --pace.threads;
  if (needed() > allowed) {
    throw core::InputError({"--memory", 0},
                           fmt::format("{} is not enough: one thread needs about {}",
                                       bytes_text(allowed), bytes_text(needed())));
  }
  if (pace.threads < threads) {
    fmt::print(stderr, "{} of {} threads, for {} of memory\n", pace.threads, threads,
               bytes_text(allowed));
  }
  return pace;
}

void limit_memory(std::uint64_t bytes, int threads) {
  if (bytes == 0) return;
  constexpr rlim_t kStack = 10 << 20;  // reserved for each thread, hardly used
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, bytes + kStack * static_cast<rlim_t>(threads));
  setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace millstudy::cli
