// SPDX-License-Identifier: MIT
#include "sweep/runner.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace millstudy::sweep {
namespace {

/// Keeps everything in memory, and checks that blocks come in order without gaps.
class MemorySink : public Sink {
 public:
  void write(const Block& block) override {
    EXPECT_EQ(block.first, static_cast<std::int64_t>(status.size()));
    status.insert(status.end(), block.status.begin(), block.status.end());
    for (std::int64_t i = 0; i < block.count; ++i) values.push_back(block.value(0, i));
  }
  void finish(const std::vector<Attribute>&) override {}

  std::vector<double> values;
  std::vector<Status> status;
};

Layout layout_of(std::int64_t points) {
  Layout layout;
  layout.dimensions = {"point"};
  layout.shape = {points};
  layout.columns = {{"square_root", "1", "square root of the number"}};
  return layout;
}

void square_roots(Block& block) {
  for (std::int64_t i = 0; i < block.count; ++i) {
    const std::int64_t number = block.first + i;
    block.status[i] = number % 10 == 3 ? Status::failed : Status::ok;
    if (block.status[i] == Status::ok) block.value(0, i) = std::sqrt(static_cast<double>(number));
  }
}

TEST(Runner, GivesTheSameBitsForAnyThreadsAndBlockSize) {
  const Layout layout = layout_of(1003);
  MemorySink reference;
  run_blocks(layout, square_roots, reference, {.threads = 1, .block_size = 1003});
  ASSERT_EQ(reference.values.size(), 1003U);
  for (const int threads : {1, 2, 7}) {
    for (const std::int64_t size : {0, 1, 10, 400}) {
      MemorySink sink;
      const Progress progress =
          run_blocks(layout, square_roots, sink, {.threads = threads, .block_size = size});
      EXPECT_EQ(progress.ok, 903);
      EXPECT_EQ(progress.failed, 100);
      EXPECT_EQ(sink.status, reference.status);
      ASSERT_EQ(sink.values.size(), reference.values.size());
      EXPECT_EQ(std::memcmp(sink.values.data(), reference.values.data(),
                            sizeof(double) * sink.values.size()),
                0);
    }
  }
}

TEST(Runner, EndsAtTheFlagWithWhatIsDone) {
  std::atomic<bool> stop = false;
  MemorySink sink;
  const Progress progress = run_blocks(
      layout_of(100'000), square_roots, sink,
      {.threads = 2, .block_size = 10, .stop = &stop, .progress = [&](const Progress& now) {
         if (now.done() >= 500) stop = true;
       }});
  EXPECT_LT(progress.done(), progress.points);
  EXPECT_GE(progress.done(), 500);
  EXPECT_EQ(progress.done(), static_cast<std::int64_t>(sink.status.size()));
}

TEST(Runner, ChoosesSmallBlocksForTraces) {
  Layout layout = layout_of(1'000'000);
  EXPECT_EQ(default_block_size(layout), 256);
  layout.traces = true;
  EXPECT_EQ(default_block_size(layout), 8);
}

}  // namespace
}  // namespace millstudy::sweep
