// SPDX-License-Identifier: MIT
#include "core/parallel_items.h"

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace millstudy::core {
namespace {

/// 0 .. count - 1.
auto counting(std::int64_t& at, std::int64_t count) {
  return [&at, count]() -> std::optional<std::int64_t> {
    if (at >= count) return std::nullopt;
    return at++;
  };
}

TEST(ParallelItems, ConsumesEveryItemOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7}) {
    std::int64_t at = 0;
    std::vector<std::int64_t> seen;
    parallel_items(
        counting(at, 1000), threads, [](std::int64_t i) { return 3 * i; },
        [&](std::int64_t value) { seen.push_back(value); });
    ASSERT_EQ(seen.size(), 1000U);
    std::sort(seen.begin(), seen.end());
    for (std::int64_t i = 0; i < 1000; ++i) ASSERT_EQ(seen[i], 3 * i);
  }
}

TEST(ParallelItems, ConsumesWhatWasBegunWhenThereIsNoMore) {
  std::atomic<bool> stop = false;
  std::int64_t begun = 0, consumed = 0;
  parallel_items(
      [&]() -> std::optional<std::int64_t> {
        if (stop) return std::nullopt;
        return begun++;
      },
      2, [](std::int64_t i) { return i; },
      [&](std::int64_t) {
        if (++consumed == 100) stop = true;
      });
  EXPECT_EQ(consumed, begun);
  EXPECT_GE(consumed, 100);
  EXPECT_LT(consumed, 200);
}

TEST(ParallelItems, KeepsFewResultsAlive) {
  std::int64_t at = 0;
  std::atomic<int> alive = 0;
  std::atomic<int> most = 0;
  parallel_items(
      counting(at, 5000), 2,
      [&](std::int64_t i) {
        const int now = ++alive;
        int seen = most;
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        return i;
      },
      [&](std::int64_t) { --alive; });
  EXPECT_LE(most.load(), 2);
}

TEST(ParallelItems, PassesAnExceptionOn) {
  std::int64_t at = 0;
  const auto run = [&] {
    parallel_items(
        counting(at, 100), 2,
        [](std::int64_t i) {
          if (i == 50) throw std::runtime_error("fifty");
          return i;
        },
        [](std::int64_t) {});
  };
  EXPECT_THROW(run(), std::runtime_error);
}

}  // namespace
}  // namespace millstudy::core
