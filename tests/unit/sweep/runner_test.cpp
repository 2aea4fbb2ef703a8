// SPDX-License-Identifier: MIT
#include "sweep/runner.h"

#include <cstring>
#include <gtest/gtest.h>

#include "unit/sweep/square_roots.h"

namespace millstudy::sweep {
namespace {

TEST(Runner, GivesTheSameBitsForAnyThreadsAndBlockSize) {
  MemorySink reference(1003);
  run_blocks(square_roots, reference, all_of(1003, 1003), {.threads = 1});
  for (const int threads : {1, 2, 7}) {
    for (const std::int64_t size : {1, 10, 400}) {
      MemorySink sink(1003);
      const Progress progress =
          run_blocks(square_roots, sink, all_of(1003, size), {.threads = threads});
      EXPECT_EQ(progress.ok, 903);
      EXPECT_EQ(progress.failed, 100);
      EXPECT_TRUE(sink.same_bits(reference));
    }
  }
}

TEST(Runner, EndsAtTheFlagWithWhatIsDone) {
  std::atomic<bool> stop = false;
  MemorySink sink(100'000);
  const Progress progress =
      run_blocks(square_roots, sink, all_of(100'000, 10),
                 {.threads = 2, .stop = &stop, .progress = [&](const Progress& now) {
                    if (now.done() >= 500) stop = true;
                  }});
  EXPECT_LT(progress.done(), progress.points);
  EXPECT_GE(progress.done(), 500);
  EXPECT_EQ(progress.done(), sink.written());
}

TEST(Runner, ChoosesSmallBlocksForTraces) {
  Layout layout;
  layout.shape = {1'000'000};
  EXPECT_EQ(default_block_size(layout), 256);
  layout.traces = true;
  EXPECT_EQ(default_block_size(layout), 8);
}

}  // namespace
}  // namespace millstudy::sweep
