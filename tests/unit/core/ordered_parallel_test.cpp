// SPDX-License-Identifier: MIT
#include "core/ordered_parallel.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace millstudy::core {
namespace {

TEST(OrderedParallel, ConsumesInOrderForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7}) {
    std::atomic<bool> stop = false;
    std::vector<std::int64_t> seen;
    const std::int64_t consumed = ordered_parallel(
        1000, threads, stop, [](std::int64_t i) { return 3 * i; },
        [&](std::int64_t i, std::int64_t value) {
          EXPECT_EQ(value, 3 * i);
          seen.push_back(i);
        });
    ASSERT_EQ(consumed, 1000);
    for (std::int64_t i = 0; i < 1000; ++i) ASSERT_EQ(seen[i], i);
  }
}

TEST(OrderedParallel, StopsEarlyWithAnUnbrokenPrefix) {
  std::atomic<bool> stop = false;
  std::int64_t last = -1;
  const std::int64_t consumed = ordered_parallel(
      1'000'000, 2, stop, [](std::int64_t i) { return i; },
      [&](std::int64_t i, std::int64_t) {
        EXPECT_EQ(i, last + 1);
        last = i;
        if (i == 100) stop = true;
      });
  EXPECT_EQ(consumed, last + 1);
  EXPECT_GE(consumed, 101);
  EXPECT_LT(consumed, 200);
}

TEST(OrderedParallel, KeepsFewResultsAlive) {
  std::atomic<bool> stop = false;
  std::atomic<int> alive = 0;
  std::atomic<int> most = 0;
  ordered_parallel(
      5000, 2, stop,
      [&](std::int64_t i) {
        const int now = ++alive;
        int seen = most;
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        return i;
      },
      [&](std::int64_t, std::int64_t) { --alive; });
  EXPECT_LE(most.load(), 8);
}

TEST(OrderedParallel, PassesAnExceptionOn) {
  std::atomic<bool> stop = false;
  const auto run = [&] {
    ordered_parallel(
        100, 2, stop,
        [](std::int64_t i) {
          if (i == 50) throw std::runtime_error("fifty");
          return i;
        },
        [](std::int64_t, std::int64_t) {});
  };
  EXPECT_THROW(run(), std::runtime_error);
}

}  // namespace
}  // namespace millstudy::core
