// SPDX-License-Identifier: MIT
#include "sweep/journal.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sys/resource.h>

#include "core/error.h"
#include "core/resource_error.h"

namespace millstudy::sweep {
namespace {

namespace fs = std::filesystem;

JournalHeader header(std::int64_t points, std::int64_t block_size, bool traces = false) {
  JournalHeader h;
  h.study_hash = "0123456789abcdef";
  h.isa = "sse4.2";
  h.build = "millstudy 0.1.0";
  h.study = "schema_version = 1\n";
  h.points = h.count = points;
  h.block_size = block_size;
  h.columns = 2;
  h.traces = traces;
  return h;
}

/// A block whose content follows from its points; every seventh fails, every fifth is skipped.
Block computed(const JournalHeader& h, std::int64_t index) {
  Block block(h.first_of(index), h.count_of(index), static_cast<std::size_t>(h.columns), h.traces);
  for (std::int64_t i = 0; i < block.count; ++i) {
    const std::int64_t point = block.first + i;
    block.status[i] = point % 7 == 3   ? Status::failed
                      : point % 5 == 4 ? Status::skipped
                                       : Status::ok;
    if (block.status[i] == Status::failed) block.failures[i] = "point " + std::to_string(point);
    if (block.status[i] != Status::ok) continue;
    block.value(0, i) = std::sqrt(static_cast<double>(point));
    block.value(1, i) = -1.0 / static_cast<double>(point + 1);
    if (!h.traces) continue;
    const auto samples = static_cast<std::size_t>(point % 4);
    for (std::vector<float>* channel :
         {&block.traces[i].time, &block.traces[i].angle, &block.traces[i].force_x,
          &block.traces[i].force_y, &block.traces[i].force_z}) {
      channel->assign(samples, static_cast<float>(point));
    }
  }
  return block;
}

void expect_same(const Block& a, const Block& b) {
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.failures, b.failures);
  ASSERT_EQ(a.values.size(), b.values.size());
  EXPECT_EQ(std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(double)), 0);
  ASSERT_EQ(a.traces.size(), b.traces.size());
  for (std::size_t i = 0; i < a.traces.size(); ++i) {
    EXPECT_EQ(a.traces[i].time, b.traces[i].time);
    EXPECT_EQ(a.traces[i].force_z, b.traces[i].force_z);
  }
}

class JournalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(::testing::TempDir()) /
        (std::string("journal-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    path_ = (folder_ / "R.h5.journal").string();
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& text) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << text;
  }
  /// A journal of all blocks but one.
  JournalHeader fill(std::int64_t points, std::int64_t size, bool traces, std::int64_t without) {
    const JournalHeader h = header(points, size, traces);
    Journal journal(path_, h, "a test");
    for (std::int64_t block = h.blocks() - 1; block >= 0; --block) {
      if (block != without) journal.append(computed(h, block), {0.5, 1.0, 0});
    }
    return h;
  }
  /// Whatever the file holds: every block is either right or computed again.
  void expect_no_wrong_value(const JournalHeader& h) {
    Journal journal(path_, h, "another");
    const std::vector<std::int64_t> pending = journal.pending();
    std::size_t next = 0;
    for (std::int64_t block = 0; block < h.blocks(); ++block) {
      if (next < pending.size() && pending[next] == block) {
        ++next;
        journal.append(computed(h, block), {});
      }
    }
    EXPECT_TRUE(journal.pending().empty());
    for (std::int64_t block = 0; block < h.blocks(); ++block) {
      expect_same(journal.read(block), computed(h, block));
    }
  }

  fs::path folder_;
  std::string path_;
};

TEST_F(JournalTest, GivesBackWhatWasAppendedInAnyOrder) {
  for (const bool traces : {false, true}) {
    const JournalHeader h = fill(1003, 10, traces, 17);
    Journal journal(path_, h, "another");
    EXPECT_EQ(journal.pending(), std::vector<std::int64_t>{17});
    EXPECT_EQ(journal.contents().done(), 993);
    for (std::int64_t block = 0; block < h.blocks(); ++block) {
      if (block != 17) expect_same(journal.read(block), computed(h, block));
    }
    EXPECT_EQ(journal.read(17).status, std::vector<Status>(10, Status::not_run));
    journal.remove();
  }
}

TEST_F(JournalTest, GoesOnWithInterruptedBlocks) {
  const JournalHeader h = header(100, 10);
  {
    Journal journal(path_, h, "a test");
    Block part = computed(h, 3);
    for (int i = 4; i < 10; ++i) part.status[i] = Status::not_run;
    part.failures.assign(10, "");
    part.failures[3] = "point 33";
    part.status[3] = Status::failed;
    journal.append(part, {});
  }
  Journal journal(path_, h, "another");
  EXPECT_EQ(journal.pending().size(), 10U);
  EXPECT_EQ(remainder(journal).done.done(), 0);
  const Block begun = journal.read(3);
  EXPECT_EQ(begun.status[9], Status::not_run);
  EXPECT_EQ(begun.value(0, 0), std::sqrt(30.0));
}

TEST_F(JournalTest, CountsABlockThatComesTwiceOnce) {
  const JournalHeader h = fill(50, 10, false, 0);
  Journal journal(path_, h, "another");
  const std::int64_t before = journal.contents().done();
  journal.append(computed(h, 2), {});
  EXPECT_EQ(journal.contents().done(), before);
  const auto again = read_journal(path_);
  EXPECT_EQ(again->done(), before);
  EXPECT_EQ(again->damaged, 0);
}

TEST_F(JournalTest, WithAnyByteChangedHoldsNoWrongValue) {
  const JournalHeader h = fill(23, 5, true, -1);
  const std::string good = bytes();
  const std::size_t beginning = encode_header(h).size();
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x41);
    write(bad);
    const bool owner = at >= kOwnerPlace && at < kHeaderPlace;
    if (at < beginning && !owner) {
      EXPECT_THROW(Journal(path_, h, "another"), core::InputError) << at;
      ++refused;
    } else {
      expect_no_wrong_value(h);
    }
  }
  EXPECT_EQ(refused, static_cast<int>(beginning - kOwnerSize));
}

TEST_F(JournalTest, TruncatedAtAnyLengthHoldsNoWrongValue) {
  const JournalHeader h = fill(23, 5, true, -1);
  const std::string good = bytes();
  const std::size_t beginning = encode_header(h).size();
  for (std::size_t length = 0; length < good.size(); ++length) {
    write(good.substr(0, length));
    if (length >= kJournalMagic.size() && length < beginning) {
      EXPECT_THROW(Journal(path_, h, "another"), core::InputError) << length;
    } else {
      expect_no_wrong_value(h);
    }
  }
}

TEST_F(JournalTest, FindsTheFramesBehindADamagedOne) {
  const JournalHeader h = fill(1000, 10, false, -1);
  std::string bad = bytes();
  // The length of the tenth frame, so that where the next begins is not known.
  const std::size_t frame = (bad.size() - encode_header(h).size()) / 100;
  bad[encode_header(h).size() + 10 * frame + 9] ^= 0x7f;
  write(bad);
  const auto contents = read_journal(path_);
  EXPECT_EQ(contents->damaged, 1);
  EXPECT_GE(contents->done(), 980);
  expect_no_wrong_value(h);
}

TEST_F(JournalTest, IsNotReadForEverWhateverItHolds) {
  const JournalHeader h = header(1'000'000'000'000, 10);
  std::string bad = encode_header(h);
  // A million beginnings of frames, each of which claims all that follows.
  std::string head(kFrameHead, '\0');
  std::memcpy(head.data(), &kFrameMarker, sizeof kFrameMarker);
  const std::uint64_t length = 12'000'000;
  std::memcpy(head.data() + 8, &length, sizeof length);
  for (int i = 0; i < 1'000'000; ++i) bad += head;
  write(bad);
  const auto contents = read_journal(path_);
  EXPECT_EQ(contents->done(), 0);
}

TEST_F(JournalTest, HasOneWriter) {
  const JournalHeader h = header(10, 10);
  Journal journal(path_, h, "process 7 on here");
  EXPECT_TRUE(Journal::is_taken(path_));
  try {
    Journal second(path_, h, "process 8 on there");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is being written by process 7 on here"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(JournalTest, OnAFullDiskLosesNothing) {
  const JournalHeader h = header(10'000, 100);
  Journal journal(path_, h, "a test");
  journal.append(computed(h, 0), {});
  const auto size = fs::file_size(path_);
  // Files may not grow beyond this: what a full disk does, in a process of its own making.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {size + 700, before.rlim_max};
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(journal.append(computed(h, 1), {}), core::ResourceError);
  EXPECT_EQ(fs::file_size(path_), size);
  setrlimit(RLIMIT_FSIZE, &before);
  journal.append(computed(h, 1), {});
  expect_same(journal.read(1), computed(h, 1));
  EXPECT_EQ(read_journal(path_)->done(), 200);
}

TEST_F(JournalTest, OfAnotherVersionSaysSo) {
  std::string bytes = encode_header(header(10, 10));
  bytes[8] = 2;
  write(bytes);
  try {
    read_journal(path_);
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is a journal of version 2"), std::string::npos);
  }
  write("schema_version = 1\n");
  EXPECT_THROW(read_journal(path_), core::InputError);
  EXPECT_FALSE(read_journal(path_ + "x").has_value());
}

TEST_F(JournalTest, IsReplayedInOrderWithWhatIsOfOthers) {
  JournalHeader h = header(100, 10);
  h.first = 30;
  h.count = 25;
  {
    Journal journal(path_, h, "a test");
    for (const std::int64_t block : {2, 0, 1}) journal.append(computed(h, block), {});
  }
  class Collect : public Sink {
   public:
    void write(const Block& block) override {
      EXPECT_EQ(block.first, static_cast<std::int64_t>(status.size()));
      status.insert(status.end(), block.status.begin(), block.status.end());
    }
    void leave_out(std::int64_t first, std::int64_t count) override {
      EXPECT_EQ(first, static_cast<std::int64_t>(status.size()));
      status.insert(status.end(), static_cast<std::size_t>(count), Status::not_run);
    }
    void finish(const std::vector<Attribute>&) override {}
    std::vector<Status> status;
  } sink;
  replay(Journal(path_, h, "another"), sink);
  ASSERT_EQ(sink.status.size(), 100U);
  EXPECT_EQ(sink.status[29], Status::not_run);
  EXPECT_NE(sink.status[30], Status::not_run);
  EXPECT_NE(sink.status[54], Status::not_run);
  EXPECT_EQ(sink.status[55], Status::not_run);
}

}  // namespace
}  // namespace millstudy::sweep
