// SPDX-License-Identifier: MIT
#include "sweep/shared_run.h"

#include <chrono>
#include <deque>
#include <gtest/gtest.h>
#include <memory>
#include <thread>

#include "core/error.h"
#include "unit/sweep/square_roots.h"

namespace millstudy::sweep {
namespace {

/// A team of threads, with a letter box for each.
class Office {
 public:
  explicit Office(int size) : boxes_(size) {}

  class Member : public Team {
   public:
    Member(Office& office, int rank) : office_(office), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return static_cast<int>(office_.boxes_.size()); }
    void send(int to, Note note, std::string bytes) override {
      const std::lock_guard lock(office_.mutex_);
      office_.boxes_[to].push_back({rank_, note, std::move(bytes)});
    }
    std::optional<Message> receive() override {
      const std::lock_guard lock(office_.mutex_);
      auto& box = office_.boxes_[rank_];
      if (box.empty()) return std::nullopt;
      Message message = std::move(box.front());
      box.pop_front();
      return message;
    }
    [[noreturn]] void abort(int) override { std::abort(); }

   private:
    Office& office_;
    int rank_;
  };

 private:
  std::mutex mutex_;
  std::vector<std::deque<Message>> boxes_;
};

JournalHeader header_of(std::int64_t points, std::int64_t block_size) {
  JournalHeader header;
  header.points = header.count = points;
  header.block_size = block_size;
  header.columns = 1;
  return header;
}

struct Outcome {
  Progress progress;
  std::int64_t by_helpers = 0;
};

Outcome shared(int ranks, std::int64_t points, std::int64_t block_size, Sink& sink,
               const Remainder& remainder, const RunOptions& options) {
  Office office(ranks);
  std::atomic<std::int64_t> by_helpers = 0;
  std::vector<std::thread> helpers;
  for (int rank = 1; rank < ranks; ++rank) {
    helpers.emplace_back([&, rank] {
      Office::Member member(office, rank);
      std::atomic<bool> stop = false;
      const auto counted = [&](Block& block) {
        square_roots(block);
        by_helpers += block.count;
      };
      help(member, "roots", counted, 2, stop);
    });
  }
  const auto slow = [](Block& block) {  // so that something is left for the helpers
    std::this_thread::sleep_for(std::chrono::microseconds(20));
    square_roots(block);
  };
  Office::Member member(office, 0);
  Outcome outcome;
  std::exception_ptr failure;
  {
    Lead lead(member);
    try {
      lead.meet("roots");
      outcome.progress = lead.run(slow, header_of(points, block_size), sink, remainder, options);
    } catch (...) {
      failure = std::current_exception();
    }
  }
  for (std::thread& helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
  outcome.by_helpers = by_helpers;
  return outcome;
}

TEST(SharedRun, GivesTheSameBitsForAnyNumberOfProcesses) {
  MemorySink reference(50'003);
  run_blocks(square_roots, reference, all_of(50'003, 10), {.threads = 1});
  for (const int ranks : {1, 2, 4, 9}) {
    MemorySink sink(50'003);
    const Outcome outcome = shared(ranks, 50'003, 10, sink, all_of(50'003, 10), {.threads = 2});
    EXPECT_EQ(outcome.progress.done(), 50'003);
    EXPECT_EQ(outcome.progress.failed, 5'000);
    EXPECT_TRUE(sink.same_bits(reference)) << ranks;
    EXPECT_EQ(outcome.by_helpers > 0, ranks > 1);
  }
}

TEST(SharedRun, GoesOnWithPointsThatAreDone) {
  Remainder half = all_of(1000, 10);
  const auto fresh = half.begin;
  half.begin = [&](std::int64_t index) {
    Block block = fresh(index);
    for (std::int64_t i = 0; i < block.count; i += 2) {
      block.status[i] = Status::ok;
      block.value(0, i) = -1.0;
    }
    return block;
  };
  MemorySink alone(1000), together(1000);
  run_blocks(square_roots, alone, half, {.threads = 1});
  shared(3, 1000, 10, together, half, {.threads = 1});
  EXPECT_TRUE(together.same_bits(alone));
}

TEST(SharedRun, EndsAtTheFlagWithWhatIsDone) {
  std::atomic<bool> stop = false;
  MemorySink sink(1'000'000);
  const Outcome outcome =
      shared(4, 1'000'000, 10, sink, all_of(1'000'000, 10),
             {.threads = 1, .stop = &stop, .progress = [&](const Progress& now) {
                if (now.done() >= 500) stop = true;
              }});
  EXPECT_GE(outcome.progress.done(), 500);
  EXPECT_LT(outcome.progress.done(), 1'000'000);
  EXPECT_EQ(outcome.progress.done(), sink.written());
}

TEST(SharedRun, EndsWithTheErrorOfTheSink) {
  class Full : public Sink {
   public:
    void write(const Block& block) override {
      if (block.first >= 500) throw std::runtime_error("no room");
    }
    void finish(const std::vector<Attribute>&) override {}
  };
  for (const int ranks : {1, 3}) {
    Full sink;
    EXPECT_THROW(shared(ranks, 100'000, 10, sink, all_of(100'000, 10), {.threads = 2}),
                 std::runtime_error);
  }
}

TEST(SharedRun, NamesWhoCannotHelp) {
  Office office(3);
  std::thread other([&] {
    Office::Member member(office, 1);
    std::atomic<bool> stop = false;
    help(member, "cubes", square_roots, 1, stop);
  });
  std::thread lost([&] {
    Office::Member member(office, 2);
    excuse(member, "no such file");
  });
  Office::Member member(office, 0);
  try {
    Lead lead(member);
    lead.meet("roots");
    ADD_FAILURE() << "met";
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.faults().size(), 2U);
  }
  other.join();
  lost.join();
}

}  // namespace
}  // namespace millstudy::sweep
