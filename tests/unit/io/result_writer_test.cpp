// SPDX-License-Identifier: MIT
#include "io/result_writer.h"

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sys/resource.h>
#include <thread>
#include <tuple>

#include "core/error.h"
#include "core/resource_error.h"
#include "io/failure_table.h"
#include "io/hdf5_text.h"
#include "io/result_reader.h"
#include "io/sample_results.h"
#include "io/sha256.h"

namespace millstudy::io {
namespace {

namespace fs = std::filesystem;
using sample::Design;

class ResultWriter : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "/result_" +
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    path_ = folder_ + "/r.h5";
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const sweep::Layout& layout, const std::vector<std::int64_t>& block_sizes) const {
    const auto writer = make_result_writer(path_, layout);
    std::size_t next = 0;
    for (std::int64_t first = 0; first < layout.points();) {
      const std::int64_t count =
          std::min(block_sizes[next++ % block_sizes.size()], layout.points() - first);
      writer->write(sample::block(layout, first, count));
      first += count;
    }
    writer->finish({{"wall_time_s", 2.0}, {"title", std::string("late")}});
  }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  std::string folder_;
  std::string path_;
};

template <class T>
std::vector<T> read(const hdf5::Handle& file, const std::string& name, hid_t type) {
  const hdf5::Handle dataset(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), "open");
  const Shape shape = hdf5::shape_of(dataset.get());
  std::vector<T> values(static_cast<std::size_t>(element_count(shape)));
  hdf5::read_range(dataset.get(), type, shape, 0, element_count(shape), values.data());
  return values;
}

std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::string> read_failures(const hdf5::Handle& file) {
  const hdf5::Handle table(H5Dopen2(file.get(), "failure", H5P_DEFAULT), "open");
  const Shape shape = hdf5::shape_of(table.get());
  return hdf5::read_texts(table.get(), shape, 0, shape[0]);
}

void expect_points(const std::string& path, const sweep::Layout& layout) {
  const hdf5::Handle file = hdf5::open_file_to_read(path);
  const auto status = read<std::int8_t>(file, "status", H5T_NATIVE_INT8);
  const auto codes = read<std::int32_t>(file, "failure_code", H5T_NATIVE_INT32);
  const std::vector<std::string> reasons = read_failures(file);
  ASSERT_EQ(static_cast<std::int64_t>(status.size()), layout.points());
  EXPECT_EQ(reasons.at(0), "none");
  for (std::size_t c = 0; c < layout.columns.size(); ++c) {
    const auto values = read<double>(file, layout.columns[c].name, H5T_NATIVE_DOUBLE);
    for (std::size_t i = 0; i < status.size(); ++i) {
      const auto point = static_cast<std::int64_t>(i);
      ASSERT_EQ(status[i], static_cast<std::int8_t>(sample::status(point)));
      const std::string failure = sample::failure(point);
      ASSERT_EQ(reasons.at(static_cast<std::size_t>(codes[i])), failure.empty() ? "none" : failure);
      if (status[i] == 0) {
        ASSERT_EQ(values[i], sample::value(c, point)) << i;
      }
      if (status[i] != 0) {
        ASSERT_TRUE(std::isnan(values[i]));
      }
    }
  }
}

void expect_traces(const std::string& path, const sweep::Layout& layout) {
  const hdf5::Handle file = hdf5::open_file_to_read(path);
  const auto start = read<std::int64_t>(file, "trace_start", H5T_NATIVE_INT64);
  const auto count = read<std::int64_t>(file, "trace_count", H5T_NATIVE_INT64);
  const auto time = read<float>(file, "trace_time", H5T_NATIVE_FLOAT);
  const auto force_z = read<float>(file, "trace_force_z", H5T_NATIVE_FLOAT);
  std::int64_t next = 0;
  for (std::int64_t i = 0; i < layout.points(); ++i) {
    const sweep::Block block = sample::block(layout, i, 1);
    const auto at = static_cast<std::size_t>(i);
    ASSERT_EQ(start[at], next);
    ASSERT_EQ(count[at], static_cast<std::int64_t>(block.traces[0].time.size()));
    for (std::int64_t k = 0; k < count[at]; ++k) {
      ASSERT_EQ(time[static_cast<std::size_t>(next + k)], block.traces[0].time[k]);
      ASSERT_EQ(force_z[static_cast<std::size_t>(next + k)], block.traces[0].force_z[k]);
    }
    next += count[at];
  }
  EXPECT_EQ(static_cast<std::int64_t>(time.size()), next);
}

TEST_F(ResultWriter, KeepsEveryPointOfEveryShapeInBlocksOfAnySize) {
  std::mt19937 random(7);
  const std::vector<std::pair<std::vector<std::int64_t>, Design>> cases = {
      {{}, Design::grid},       {{1}, Design::grid},        {{97}, Design::grid},
      {{3, 50}, Design::grid},  {{4, 3, 11}, Design::grid}, {{2, 3, 5, 7}, Design::grid},
      {{150000}, Design::grid}, {{3, 70001}, Design::grid}, {{500, 3, 100}, Design::grid},
      {{100}, Design::zip},     {{131072}, Design::zip}};
  for (const auto& [shape, design] : cases) {
    const sweep::Layout layout = sample::layout(shape, design, false);
    std::vector<std::int64_t> sizes;
    for (int i = 0; i < 10; ++i) {
      sizes.push_back(std::uniform_int_distribution<std::int64_t>(
          1, std::max<std::int64_t>(layout.points() / 5, 2))(random));
    }
    write(layout, sizes);
    expect_points(path_, layout);
    EXPECT_EQ(files(), 1u);
  }
}

TEST_F(ResultWriter, KeepsTraces) {
  for (const std::vector<std::int64_t>& shape :
       std::vector<std::vector<std::int64_t>>{{}, {60}, {4, 30}, {100000}}) {
    const sweep::Layout layout = sample::layout(shape, Design::grid, true);
    write(layout, {3, 1, 1000});
    expect_points(path_, layout);
    expect_traces(path_, layout);
  }
}

TEST_F(ResultWriter, LeavesOutPointsAsIfTheyWereNotRun) {
  for (const auto& [shape, first, end] :
       {std::tuple<Shape, std::int64_t, std::int64_t>{{20000}, 7000, 13001},
        {{3, 70001}, 0, 5000},
        {{40, 3, 500}, 59999, 60000},
        {{6, 11}, 60, 66},
        {{}, 0, 0}}) {
    for (const bool traces : {false, true}) {
      sweep::Layout layout = sample::layout(shape, Design::grid, traces && end - first < 100);
      layout.points_here = end - first;
      const std::int64_t rest = layout.points() - end;
      std::vector<std::string> contents;
      for (const bool leaves_out : {false, true}) {
        const auto writer = make_result_writer(path_, layout);
        const auto pass = [&](std::int64_t from, std::int64_t count) {
          if (leaves_out) return writer->leave_out(from, count);
          if (count == 0) return;
          writer->write(sweep::Block(from, count, layout.columns.size(), layout.traces));
        };
        pass(0, first);
        writer->write(sample::block(layout, first, end - first));
        pass(end, rest);
        EXPECT_THROW(writer->leave_out(0, 1), std::logic_error);
        writer->finish({});
        contents.push_back(read_bytes(path_));
      }
      EXPECT_TRUE(contents[0] == contents[1]) << first << " to " << end;
    }
  }
}

TEST_F(ResultWriter, DoesNotDependOnTheSizeOfBlocks) {
  const sweep::Layout layout = sample::layout({4, 30, 20}, Design::grid, true);
  std::vector<std::string> contents;
  for (const std::int64_t size : {1, 17, 100000}) {
    write(layout, {size});
    contents.push_back(read_bytes(path_));
    std::this_thread::sleep_for(std::chrono::milliseconds(600));  // no times of day inside
  }
  EXPECT_EQ(contents[0], contents[1]);
  EXPECT_EQ(contents[0], contents[2]);
}

TEST_F(ResultWriter, ShrinksColumnsThatRepeatThemselves) {
  sweep::Layout layout = sample::layout({100, 3000}, Design::grid, false);
  layout.columns.resize(1);
  const auto write_values = [&](double inner) {
    const auto writer = make_result_writer(path_, layout);
    sweep::Block block(0, 300000, 1, false);
    for (std::int64_t i = 0; i < block.count; ++i) {
      block.value(0, i) = std::sqrt(static_cast<double>(i / 3000) + inner * static_cast<double>(i));
      block.status[static_cast<std::size_t>(i)] = sweep::Status::ok;
    }
    writer->write(block);
    writer->finish({});
    const hdf5::Handle file = hdf5::open_file_to_read(path_);
    EXPECT_EQ(read<double>(file, layout.columns[0].name, H5T_NATIVE_DOUBLE), block.values);
    return fs::file_size(path_);
  };
  EXPECT_LT(write_values(0.0), 200000u);
  EXPECT_GT(write_values(0.1), 2400000u);
}

TEST_F(ResultWriter, LeavesNothingWhenAbandoned) {
  const sweep::Layout layout = sample::layout({100}, Design::grid, false);
  std::ofstream(path_) << "an older result";
  {
    const auto writer = make_result_writer(path_, layout);
    writer->write(sample::block(layout, 0, 50));
    EXPECT_EQ(files(), 2u);
  }
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(fs::file_size(path_), 15u);
}

TEST_F(ResultWriter, RefusesPathsThatCannotBecomeAResult) {
  const sweep::Layout layout = sample::layout({3}, Design::grid, false);
  for (const std::string& path : {folder_ + "/none/r.h5", folder_, std::string("/dev/null"),
                                  std::string(), std::string("/proc/r.h5")}) {
    EXPECT_THROW(make_result_writer(path, layout), core::InputError) << path;
  }
  EXPECT_THROW(make_result_writer(
                   path_, sample::layout(std::vector<std::int64_t>(33, 1), Design::grid, false)),
               core::InputError);
  EXPECT_EQ(files(), 0u);
}

TEST_F(ResultWriter, RefusesAPathThatIsBeingWritten) {
  const sweep::Layout layout = sample::layout({1}, Design::grid, false);
  const auto first = make_result_writer(path_, layout);
  EXPECT_THROW(make_result_writer(path_, layout), core::InputError);
  first->write(sample::block(layout, 0, 1));
  first->finish({});
  EXPECT_TRUE(fs::exists(path_));
}

TEST_F(ResultWriter, TakesOverWhatAKilledRunLeft) {
  const sweep::Layout layout = sample::layout({10}, Design::grid, false);
  std::ofstream(path_ + ".tmp") << std::string(100000, 'x');
  write(layout, {3});
  expect_points(path_, layout);
}

TEST_F(ResultWriter, SaysThatTheDiskIsFull) {
  // A limit on file size makes writes fail in the same way, after some have succeeded.
  const sweep::Layout layout = sample::layout({1000, 1000}, Design::grid, false);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1 << 20, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  {
    const auto writer = make_result_writer(path_, layout);
    std::int64_t first = 0;
    EXPECT_THROW(
        for (; first < 1000000; first += 1000) writer->write(sample::block(layout, first, 1000)),
        core::ResourceError);
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(files(), 0u);
  write(sample::layout({10}, Design::grid, false), {3});  // the library still works
}

TEST_F(ResultWriter, KeepsAttributesOfAnySize) {
  sweep::Layout layout = sample::layout({5}, Design::grid, false);
  const std::string study = std::string(300000, 's') + "\nµm";
  layout.attributes.push_back({"study", study});
  write(layout, {2});
  const ResultSummary summary = read_result_summary(path_).value();
  EXPECT_EQ(summary.text("study"), study);
  EXPECT_EQ(summary.text("Conventions"), "CF-1.8");
  EXPECT_EQ(summary.text("study_hash"), "0123abcd");
  EXPECT_EQ(summary.text("title"), "late");
  EXPECT_EQ(summary.integer("schema_version"), 1);
  EXPECT_EQ(std::get<double>(summary.attributes.at("wall_time_s")), 2.0);
  EXPECT_FALSE(summary.text("schema_version"));
}

TEST_F(ResultWriter, ReadsNoSummaryOfWhatIsNoResult) {
  EXPECT_FALSE(read_result_summary(path_));
  std::ofstream(path_) << "not HDF5";
  EXPECT_THROW(read_result_summary(path_), core::InputError);
  EXPECT_THROW(read_result_summary(folder_), core::InputError);
  write(sample::layout({50}, Design::grid, false), {20});
  for (auto size = static_cast<std::int64_t>(fs::file_size(path_)) - 1; size >= 0; size -= 97) {
    fs::resize_file(path_, static_cast<std::uintmax_t>(size));
    EXPECT_THROW(read_result_summary(path_), core::InputError) << size;
  }
}

TEST(FailureTable, NumbersReasonsByFirstAppearanceAndIsBounded) {
  FailureTable table;
  EXPECT_EQ(table.code(""), 0);
  EXPECT_EQ(table.code("b"), 1);
  EXPECT_EQ(table.code("a"), 2);
  EXPECT_EQ(table.code("b"), 1);
  for (int i = 0; i < 20000; ++i) table.code(std::to_string(i));
  EXPECT_EQ(table.reasons().size(), 10002u);
  EXPECT_EQ(table.reasons().back(), "other failures");
  EXPECT_EQ(table.code("another"), 10001);
  EXPECT_EQ(table.code("a"), 2);
}

TEST(Sha256, IsThatOfFips180) {
  // NIST FIPS 180-4 examples.
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace millstudy::io
