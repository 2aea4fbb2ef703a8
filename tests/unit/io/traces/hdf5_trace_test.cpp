// SPDX-License-Identifier: MIT
#include <csignal>
#include <gtest/gtest.h>
#include <numeric>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "identify/error_text.h"
#include "identify/prepare_trace.h"
#include "io/hdf5.h"
#include "io/trace_file.h"
#include "io/traces/contained.h"
#include "test_file.h"

namespace millstudy::io {
namespace {

std::vector<double> ramp(std::size_t count, double first = 0.0) {
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

template <class T>
void write(hid_t file, const char* name, const std::vector<T>& values, hid_t stored, hid_t memory,
           const Shape& shape, const char* unit = nullptr) {
  const hdf5::Handle dataset = hdf5::create_dataset(file, name, stored, shape);
  hdf5::write_range(dataset.get(), memory, shape, 0, element_count(shape), values.data());
  if (unit != nullptr) hdf5::write_attribute(dataset.get(), "units", std::string(unit));
}

class Hdf5Trace : public testing::Test {
 protected:
  Hdf5Trace() {
    const hdf5::Handle file(
        H5Fcreate(disk_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), "create a file");
    const hdf5::Handle group(H5Gcreate2(file.get(), "run", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             "create a group");
    write(file.get(), "Fx", ramp(20), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {20}, "kN");
    write(file.get(), "big", ramp(20, 3.0), H5T_STD_I16BE, H5T_NATIVE_DOUBLE, {20});
    write(group.get(), "Fy", ramp(20, 7.0), H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, {1, 20});
    write(group.get(), "data", ramp(60), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {20, 3});
    write(file.get(), "scalar", ramp(1), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {});
    hdf5::write_attribute(file.get(), "title", std::string("a test"));
  }
  TraceFile read(const std::string& variable) const {
    return read_trace_file(disk_.path(), {.variables = {{"Fx", variable}}});
  }
  std::vector<double> samples(const std::string& variable) const {
    return read(variable).channels.find("Fx")->samples;
  }
  std::string fault(const std::string& variable) const {
    return error_text([&] { read(variable); });
  }
  TestFile disk_;
};

TEST_F(Hdf5Trace, ReadsDatasetsByPathWithTheirUnit) {
  const TraceFile file = read("Fx");
  EXPECT_EQ(file.format, "HDF5");
  EXPECT_EQ(file.channels.channels[0].unit, "kN");
  EXPECT_EQ(samples("Fx"), ramp(20));
  EXPECT_EQ(samples("/Fx"), ramp(20));
  EXPECT_EQ(samples("big"), ramp(20, 3.0));
  EXPECT_EQ(samples("run/Fy"), ramp(20, 7.0));
}

TEST_F(Hdf5Trace, ReadsColumnsAsPythonCountsOrAsMatlabDoes) {
  std::vector<double> second;
  for (int i = 0; i < 20; ++i) second.push_back(3.0 * i + 1.0);
  EXPECT_EQ(samples("run/data[:,1]"), second);
  EXPECT_EQ(samples("run/data(2,:)"), second);  // MATLAB sees it 3 x 20
  EXPECT_EQ(samples("run/data[1,:]"), (std::vector<double>{3, 4, 5}));
  EXPECT_TRUE(contains(fault("run/data[:,3]"), "is not there"));
  EXPECT_TRUE(contains(fault("run/data"), "ask for run/data[:,0]"));
  EXPECT_TRUE(contains(fault("Fx[:,0]"), "1 dimensions, not 2"));
}

TEST_F(Hdf5Trace, ReadsARangeAlone) {
  const TraceFile file = read_trace_file(
      disk_.path(), {.variables = {{"Fx", "Fx"}}, .range = TraceSelection::Range{5, 3}});
  EXPECT_EQ(file.channels.channels[0].samples, ramp(3, 5.0));
  EXPECT_TRUE(contains(error_text([&] {
                         read_trace_file(disk_.path(), {.variables = {{"Fx", "Fx"}},
                                                        .range = TraceSelection::Range{19, 2}});
                       }),
                       "does not have samples 19 ... 20"));
}

TEST_F(Hdf5Trace, SaysWhatIsThere) {
  EXPECT_TRUE(contains(fault("Fq"), "has no dataset Fq; it has Fx, big, run/Fy, run/data"))
      << fault("Fq");
  EXPECT_TRUE(contains(fault("run"), "run is no dataset"));
  EXPECT_TRUE(contains(fault("scalar"), "is a single number"));
  EXPECT_TRUE(
      contains(error_text([&] { read_trace_file(disk_.path()); }), "say which of its datasets"));
  EXPECT_TRUE(contains(error_text([&] {
                         read_trace_file(disk_.path(), {.variables = {{"Fx", "Fx"}}, .point = 0});
                       }),
                       "has no points"));
}

TEST(Hdf5Limit, RefusesMoreValuesThanFitButReadsAPartOfThem) {
  const TestFile disk;
  {
    const hdf5::Handle file(H5Fcreate(disk.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                            "create a file");
    // Chunks that nobody wrote take no space.
    hdf5::create_dataset(file.get(), "Fx", H5T_IEEE_F64LE, {300'000'000}, {.chunk = {100'000}});
  }
  EXPECT_LT(std::filesystem::file_size(disk.path()), 1'000'000u);
  TraceSelection selection{.variables = {{"Fx", "Fx"}}};
  EXPECT_TRUE(contains(error_text([&] { read_trace_file(disk.path(), selection); }),
                       "more than 200000000 values"));
  selection.range = TraceSelection::Range{299'999'000, 1000};
  EXPECT_EQ(read_trace_file(disk.path(), selection).channels.channels[0].samples,
            std::vector<double>(1000, 0.0));
}

TEST_F(Hdf5Trace, ATruncatedFileIsRefused) {
  std::ifstream in(disk_.path(), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (const std::size_t size : {std::size_t{8}, std::size_t{100}, bytes.size() / 2}) {
    const TestFile file(bytes.substr(0, size));
    EXPECT_NE(error_text([&] {
                read_trace_file(file.path(), {.variables = {{"Fx", "Fx"}}});
              }),
              "")
        << size;
  }
}

/// A result with the histories of a grid of 2 x 2 points, the third of which failed.
class ResultFile : public testing::Test {
 protected:
  ResultFile() {
    const hdf5::Handle file(
        H5Fcreate(disk_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), "create a file");
    const std::vector<std::int64_t> start = {0, 20, 50, 50};
    const std::vector<std::int64_t> count = {20, 30, 0, 40};
    write(file.get(), "trace_start", start, H5T_STD_I64LE, H5T_NATIVE_INT64, {2, 2});
    write(file.get(), "trace_count", count, H5T_STD_I64LE, H5T_NATIVE_INT64, {2, 2});
    std::vector<double> time;
    for (const std::int64_t samples : count) {
      for (int i = 0; i < samples; ++i) time.push_back(i / 3000.0);
    }
    write(file.get(), "trace_time", time, H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, {90}, "s");
    for (const char* name : {"trace_force_x", "trace_force_y", "trace_force_z"}) {
      write(file.get(), name, ramp(90), H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, {90}, "N");
    }
  }
  TestFile disk_;
};

TEST_F(ResultFile, ReadsTheHistoryOfAPointWithItsTimes) {
  const identify::ChannelSet set = read_trace_file(disk_.path(), {.point = 1}).channels;
  EXPECT_EQ(set.find("Fx")->samples, ramp(30, 20.0));
  EXPECT_EQ(set.find("Fz")->unit, "N");
  ASSERT_EQ(set.time.size(), 30u);
  EXPECT_EQ(set.time[0], 0.0);
  identify::TraceOptions options;
  options.axes = identify::parse_axis_map({"Fx", "Fy", "Fz"});
  EXPECT_EQ(identify::prepare_trace(set, options).trace.sampling_rate, 3000.0);
  const identify::ChannelSet last =
      read_trace_file(disk_.path(), {.variables = {{"F", "trace_force_y"}}, .point = 3}).channels;
  EXPECT_EQ(last.find("F")->samples, ramp(40, 50.0));
}

TEST_F(ResultFile, SaysWhichPointsHaveNoHistory) {
  const auto fault = [&](const TraceSelection& selection) {
    return error_text([&] { read_trace_file(disk_.path(), selection); });
  };
  EXPECT_TRUE(contains(fault({.point = 2}), "point 2 has no samples"));
  EXPECT_TRUE(contains(fault({.point = 4}), "point = 4 must be < 4"));
  EXPECT_TRUE(contains(fault({.point = -1}), "point = -1 must be >= 0"));
  EXPECT_TRUE(contains(fault({}), "histories of 4 points: say which"));
}

TEST(ReadContained, TurnsACrashIntoAnError) {
  const Source source{"a.h5", "bytes"};
  EXPECT_EQ(error_text([&] {
              read_contained(source, []() -> TraceFile {
                std::raise(SIGSEGV);
                return {};
              });
            }),
            "a.h5: is damaged: the library that reads it failed");
  EXPECT_EQ(
      error_text([&] { read_contained(source, []() -> TraceFile { throw std::bad_alloc(); }); }),
      "a.h5: needs too much memory, or is damaged");
  EXPECT_EQ(error_text([&] {
              read_contained(source, []() -> TraceFile { throw std::runtime_error("no"); });
            }),
            "a.h5: cannot be read: no");
  EXPECT_EQ(error_text([&] {
              read_contained(source, []() -> TraceFile {
                throw core::InputError({{{"b", 2}, "one"}, {{"c", 0}, "two"}});
              });
            }),
            "b:2: one\nc: two");
}

TEST(ReadContained, HandsOverEverything) {
  TraceFile file{"format", {}};
  file.channels.channels = {{"Fx", "N", ramp(100000)}, {"Fy", "", {}}};
  file.channels.time = ramp(3);
  file.channels.sampling_rate = 10.0;
  file.channels.start = 2.0;
  file.channels.remarks = {"one", "two"};
  const TraceFile read = read_contained({"a", "b"}, [&] { return file; });
  EXPECT_EQ(read.format, "format");
  EXPECT_EQ(read.channels.channels[0].samples, file.channels.channels[0].samples);
  EXPECT_EQ(read.channels.channels[0].unit, "N");
  EXPECT_EQ(read.channels.channels[1].name, "Fy");
  EXPECT_EQ(read.channels.time, file.channels.time);
  EXPECT_EQ(read.channels.sampling_rate, 10.0);
  EXPECT_EQ(read.channels.start, 2.0);
  EXPECT_EQ(read.channels.remarks, file.channels.remarks);
}

/// The process that reads holds a pipe of ours, too, which closes when it ends.
TEST(ReadContained, EndsWhenNobodyListensAnyMore) {
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t listener = ::fork();
  if (listener == 0) {
    const pid_t self = ::getpid();
    read_contained({"a", "b"}, [&] {
      ::kill(self, SIGKILL);
      TraceFile file{"format", {}};
      file.channels.channels = {{"Fx", "N", ramp(1000000)}};  // more than a pipe holds
      return file;
    });
    ::_exit(0);
  }
  ::close(ends[1]);
  ASSERT_EQ(::waitpid(listener, nullptr, 0), listener);
  pollfd end = {ends[0], POLLIN, 0};
  EXPECT_EQ(::poll(&end, 1, 10000), 1);
  ::close(ends[0]);
}

}  // namespace
}  // namespace millstudy::io
