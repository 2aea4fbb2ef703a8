// SPDX-License-Identifier: MIT
#include "io/result_blocks.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <zlib.h>

#include "core/error.h"
#include "io/hdf5.h"
#include "io/result_variables.h"
#include "io/result_writer.h"
#include "io/sample_results.h"

namespace millstudy::io {
namespace {

namespace fs = std::filesystem;
using sample::Design;

/// Points of a study that one part of it has run.
struct Part {
  std::int64_t first;
  std::int64_t end;
};

class ResultBlocksTest : public testing::Test {
 protected:
  void SetUp() override {
    path_ = testing::TempDir() + "/blocks_" +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
  }
  void TearDown() override { fs::remove(path_); }

  void write(sweep::Layout layout, const Part& part) const {
    layout.points_here = part.end - part.first;
    const auto writer = make_result_writer(path_, layout);
    writer->leave_out(0, part.first);
    writer->write(sample::block(layout, part.first, part.end - part.first));
    writer->leave_out(part.end, layout.points() - part.end);
    writer->finish({});
  }

  std::string path_;
};

/// What read() should give.
sweep::Block expected(const sweep::Layout& layout, const Part& part, std::int64_t first,
                      std::int64_t count) {
  sweep::Block block(first, count, layout.columns.size(), layout.traces);
  for (std::int64_t i = 0; i < count; ++i) {
    if (first + i < part.first || first + i >= part.end) continue;
    const sweep::Block point = sample::block(layout, first + i, 1);
    block.status[i] = point.status[0];
    block.failures[i] = point.failures[0];
    for (std::size_t c = 0; c < layout.columns.size(); ++c) block.value(c, i) = point.value(c, 0);
    if (layout.traces) block.traces[i] = point.traces[0];
  }
  return block;
}

void expect_same(const sweep::Block& block, const sweep::Block& other) {
  ASSERT_EQ(block.first, other.first);
  ASSERT_EQ(block.count, other.count);
  ASSERT_EQ(block.status, other.status);
  ASSERT_EQ(block.failures, other.failures);
  if (!block.values.empty()) {  // they may be left out where nothing was run
    ASSERT_EQ(block.values.size(), other.values.size());
    ASSERT_EQ(
        std::memcmp(block.values.data(), other.values.data(), block.values.size() * sizeof(double)),
        0);
  }
  ASSERT_EQ(block.traces.size(), block.values.empty() ? 0 : other.traces.size());
  for (std::size_t i = 0; i < block.traces.size(); ++i) {
    for (const TraceChannel& channel : kTraceChannels) {
      ASSERT_EQ(block.traces[i].*channel.samples, other.traces[i].*channel.samples);
    }
  }
}

TEST_F(ResultBlocksTest, GiveEveryRangeBackBitForBit) {
  std::mt19937 random(1);
  const Part part = {7777, 21234};
  const std::vector<std::vector<std::int64_t>> shapes = {{30000}, {300, 100}, {2, 15, 1000}};
  for (const std::vector<std::int64_t>& shape : shapes) {
    for (const bool traces : {false, true}) {
      const sweep::Layout layout = sample::layout(shape, Design::grid, traces);
      write(layout, part);
      const ResultBlocks blocks(path_);
      sweep::Block used(0, 0, 0, false);  // again and again
      for (int trial = 0; trial < 20; ++trial) {
        std::uniform_int_distribution<std::int64_t> any(0, layout.points() - 1);
        const std::int64_t one = any(random), other = any(random);
        const std::int64_t first = std::min(one, other), count = std::max(one, other) - first + 1;
        blocks.read(first, count, used);
        expect_same(used, expected(layout, part, first, count));
        expect_same(blocks.read(first, count), used);
      }
    }
  }
}

TEST_F(ResultBlocksTest, SayWhereAChunkEnds) {
  const sweep::Layout layout = sample::layout({300, 100}, Design::grid, false);
  write(layout, {0, 30000});  // chunks of a sixteenth of it at most
  const ResultBlocks blocks(path_);
  const std::int64_t chunk = blocks.chunk_end(0);
  EXPECT_EQ(chunk % 100, 0);
  EXPECT_LE(chunk, 30000 / 16);
  EXPECT_GT(chunk, 30000 / 32);
  EXPECT_EQ(blocks.chunk_end(chunk - 1), chunk);
  EXPECT_EQ(blocks.chunk_end(chunk), 2 * chunk);
  EXPECT_EQ(blocks.chunk_end(29999), 30000);
}

/// Copies a result, chunks as they are where that can be.
/// @return the points of those that could not
std::vector<std::int64_t> copy_packed(const std::string& from, const std::string& to) {
  const ResultBlocks old(from);
  const auto writer = make_result_writer(to, old.layout());
  EXPECT_EQ(writer->chunk(), old.layout().chunk);
  std::vector<std::int64_t> read;
  PackedPoints packed;
  for (std::int64_t next = 0; next < old.layout().points();) {
    if (old.read_packed(next, old.layout().points(), packed)) {
      EXPECT_EQ(packed.first, next);
      writer->write(packed);
      next += packed.count;
    } else {
      read.push_back(next);
      const std::int64_t end = old.chunk_end(next);
      writer->write(old.read(next, end - next));
      next = end;
    }
  }
  writer->finish({});
  return read;
}

TEST_F(ResultBlocksTest, GiveChunksAsTheyAre) {
  for (const std::vector<std::int64_t>& shape :
       std::vector<std::vector<std::int64_t>>{{30000}, {300, 100}, {2, 15, 1000}}) {
    sweep::Layout layout = sample::layout(shape, Design::grid, false);
    layout.points_here = 30000;
    sweep::Block block = sample::block(layout, 0, 30000);
    for (std::int64_t i = 0; i < 30000; ++i) {
      for (std::size_t c = 0; c < layout.columns.size(); ++c)
        block.value(c, i) = c == 2 ? 7.0 : c == 1 && i < 20000 ? kMissing : sample::value(c, i);
    }
    block.status.assign(30000, sweep::Status::ok);
    block.failures.assign(30000, "");
    block.status[12345] = sweep::Status::failed;
    block.failures[12345] = "too long";
    {
      const auto writer = make_result_writer(path_, layout);
      writer->write(block);
      writer->finish({});
    }
    const std::string copy = path_ + ".copy";
    const std::vector<std::int64_t> read = copy_packed(path_, copy);
    const ResultBlocks old(path_);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_LE(read[0], 12345);
    EXPECT_GT(old.chunk_end(read[0]), 12345);
    expect_same(ResultBlocks(copy).read(0, 30000), block);
    EXPECT_NEAR(static_cast<double>(fs::file_size(copy)), static_cast<double>(fs::file_size(path_)),
                4096.0);
    PackedPoints packed;
    EXPECT_FALSE(old.read_packed(1, 30000, packed));
    EXPECT_FALSE(old.read_packed(0, old.chunk_end(0) - 1, packed));
    EXPECT_TRUE(old.read_packed(0, old.chunk_end(0), packed));
    EXPECT_EQ(packed.count, old.chunk_end(0));
    fs::remove(copy);
  }
}

TEST_F(ResultBlocksTest, DoNotGiveChunksOfTimeHistoriesAsTheyAre) {
  write(sample::layout({30000}, Design::grid, true), {0, 30000});
  PackedPoints packed;
  EXPECT_FALSE(ResultBlocks(path_).read_packed(0, 30000, packed));
}

TEST_F(ResultBlocksTest, TakeNoSpaceForResultsOfOtherParts) {
  for (const bool traces : {false, true}) {
    const auto size = [&](std::int64_t rows) {
      write(sample::layout({rows, 1000}, Design::grid, traces), {5000, 15000});
      return static_cast<std::int64_t>(fs::file_size(path_));
    };
    const std::int64_t small = size(20);
    EXPECT_LT(size(1000) - small, 980 * 8 + 1000);  // the coordinate
  }
}

/// Sets one more sample, which is not there, in a table of a file.
void claim_one_more(const std::string& path, const char* name) {
  const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "open");
  const hdf5::Handle dataset(H5Dopen2(file.get(), name, H5P_DEFAULT), "open");
  const hsize_t length = static_cast<hsize_t>(hdf5::shape_of(dataset.get())[0]) + 1;
  hdf5::check(H5Dset_extent(dataset.get(), &length), "extend");
}

TEST_F(ResultBlocksTest, RefuseTracesOfOtherLengths) {
  const sweep::Layout layout = sample::layout({30000}, Design::grid, true);
  for (const char* const name : {"trace_time", "trace_force_y"}) {
    write(layout, {0, 30000});
    claim_one_more(path_, name);
    EXPECT_THROW(ResultBlocks{path_}, core::InputError) << name;
  }
}

/// What gzip makes of so many equal bytes.
std::string packed(std::size_t bytes) {
  const std::string plain(bytes, '\1');
  std::string result(::compressBound(bytes), '\0');
  uLongf length = result.size();
  ::compress(reinterpret_cast<Bytef*>(result.data()), &length,
             reinterpret_cast<const Bytef*>(plain.data()), plain.size());
  result.resize(length);
  return result;
}

TEST_F(ResultBlocksTest, RefuseChunksThatCannotBeUnpacked) {
  const sweep::Layout layout = sample::layout({30, 1000}, Design::grid, false);
  write(layout, {0, 30000});
  std::size_t size = 0;
  {
    const hdf5::Handle file = hdf5::open_file_to_read(path_);
    const hdf5::Handle status(H5Dopen2(file.get(), "status", H5P_DEFAULT), "open");
    size = static_cast<std::size_t>(element_count(hdf5::chunk_of(status.get())));
  }
  const auto read_with = [&](const std::string& chunk, std::uint32_t skipped) {
    write(layout, {0, 30000});
    {
      const hdf5::Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "open");
      const hdf5::Handle status(H5Dopen2(file.get(), "status", H5P_DEFAULT), "open");
      const std::array<hsize_t, 2> start = {0, 0};
      hdf5::check(H5Dwrite_chunk(status.get(), H5P_DEFAULT, skipped, start.data(), chunk.size(),
                                 chunk.data()),
                  "write");
    }
    return ResultBlocks(path_).read(0, 30000);
  };
  EXPECT_EQ(read_with(packed(size), 0).status[size - 1], static_cast<sweep::Status>(1));
  EXPECT_THROW(read_with("no gzip", 0), core::InputError);
  EXPECT_THROW(read_with(packed(size - 1), 0), core::InputError);
  EXPECT_THROW(read_with(packed(size + 1), 0), core::InputError);
  EXPECT_THROW(read_with(packed(size).substr(0, packed(size).size() / 2), 0), core::InputError);
  EXPECT_THROW(read_with(std::string(3 * size + 100, '\1'), 0), core::InputError);
  EXPECT_THROW(read_with(std::string(size - 1, '\1'), hdf5::kAllFilters), core::InputError);
}

/// Makes the record of the first chunk of a variable with two dimensions say that nothing is
/// stored.
void forget_first_chunk(const std::string& path, const char* name) {
  std::array<std::uint32_t, 2> record = {0, 0};  // bytes, filters that were skipped
  {
    const hdf5::Handle file = hdf5::open_file_to_read(path);
    const hdf5::Handle dataset(H5Dopen2(file.get(), name, H5P_DEFAULT), "open");
    const std::array<hsize_t, 2> start = {0, 0};
    hsize_t bytes = 0;
    hdf5::check(H5Dget_chunk_storage_size(dataset.get(), start.data(), &bytes), "look");
    record[0] = static_cast<std::uint32_t>(bytes);
  }
  std::string key(reinterpret_cast<const char*>(record.data()), sizeof record);
  key.append(3 * sizeof(std::uint64_t), '\0');  // its place, and that within an element
  std::string file;
  {
    std::ifstream in(path, std::ios::binary);
    file.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::size_t at = file.find(key);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(file.find(key, at + 1), std::string::npos);
  file.replace(at, sizeof(std::uint32_t), sizeof(std::uint32_t), '\0');
  std::ofstream(path, std::ios::binary | std::ios::trunc) << file;
}

/// A chunk whose record says that nothing of it is stored is no chunk that was left out.
TEST_F(ResultBlocksTest, RefuseChunksOfNoBytes) {
  write(sample::layout({30, 1000}, Design::grid, false), {0, 30000});
  forget_first_chunk(path_, "status");
  EXPECT_THROW(ResultBlocks(path_).read(0, 30000), core::InputError);
}

class PackedPointsTest : public ResultBlocksTest {
 protected:
  /// Points that are all ok.
  void write_ok() const {
    sweep::Layout layout = sample::layout({30, 1000}, Design::grid, false);
    layout.points_here = 30000;
    sweep::Block block(0, 30000, layout.columns.size(), false);
    std::fill(block.values.begin(), block.values.end(), 7.0);
    block.status.assign(30000, sweep::Status::ok);
    block.failures.assign(30000, "");
    for (std::int64_t i = 0; i < 30000; ++i) {
      block.value(0, i) = sample::value(0, i);
      block.value(1, i) = static_cast<double>(i / 100);
    }
    const auto writer = make_result_writer(path_, layout);
    writer->write(block);
    writer->finish({});
  }

  /// A variable of the file with nothing in it.
  void replace(const char* name, hid_t type, double fill) const {
    const hdf5::Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "open");
    Shape chunk;
    {
      const hdf5::Handle old(H5Dopen2(file.get(), name, H5P_DEFAULT), "open");
      chunk = hdf5::chunk_of(old.get());
    }
    hdf5::check(H5Ldelete(file.get(), name, H5P_DEFAULT), "delete");
    const hdf5::Handle dataset = hdf5::create_dataset(file.get(), name, type, {30, 1000},
                                                      {.chunk = chunk, .gzip = 1, .fill = fill});
    for (const std::size_t d : {0, 1}) {
      const hdf5::Handle scale(
          H5Dopen2(file.get(), ("axis_" + std::to_string(d)).c_str(), H5P_DEFAULT), "open");
      hdf5::attach_scale(dataset.get(), scale.get(), d);
    }
  }

  PackedPoints packed_;
};

TEST_F(PackedPointsTest, AreNotThereForAChunkOfNoBytes) {
  write_ok();
  ASSERT_TRUE(ResultBlocks(path_).read_packed(0, 30000, packed_));
  forget_first_chunk(path_, "feed_fluctuation_max");
  EXPECT_THROW(ResultBlocks(path_).read_packed(0, 30000, packed_), core::InputError);
}

/// What is not stored has the fill value of that file, which is not for ever that of the copy.
TEST_F(PackedPointsTest, AreNotThereForAnotherFillValue) {
  write_ok();
  replace("steps", H5T_IEEE_F64LE, 5.0);
  EXPECT_EQ(ResultBlocks(path_).read(0, 1).values.back(), 5.0);
  EXPECT_FALSE(ResultBlocks(path_).read_packed(0, 30000, packed_));
  write_ok();
  replace("status", H5T_STD_I8LE, 0.0);
  EXPECT_EQ(ResultBlocks(path_).read(0, 1).status.back(), sweep::Status::ok);
  EXPECT_FALSE(ResultBlocks(path_).read_packed(0, 30000, packed_));
}

TEST_F(ResultBlocksTest, RefuseTracesThatAreNotThere) {
  write(sample::layout({300}, Design::grid, true), {0, 300});
  {
    const hdf5::Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "open");
    for (const TraceChannel& channel : kTraceChannels) {
      const hdf5::Handle dataset(H5Dopen2(file.get(), channel.name, H5P_DEFAULT), "open");
      const hsize_t length = hsize_t{1} << 62;
      hdf5::check(H5Dset_extent(dataset.get(), &length), "extend");
    }
  }
  EXPECT_THROW(ResultBlocks{path_}, core::InputError);
}

}  // namespace
}  // namespace millstudy::io
