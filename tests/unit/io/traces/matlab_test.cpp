// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <matio.h>
#include <numeric>

#include "identify/error_text.h"
#include "io/trace_file.h"
#include "test_file.h"

namespace millstudy::io {
namespace {

constexpr std::size_t kSamples = 50;

template <class T>
std::vector<T> ramp(std::size_t count, T first = 0) {
  std::vector<T> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

std::vector<double> ramp_double(std::size_t count, double first = 0.0) {
  return ramp<double>(count, first);
}

/// A MATLAB file with variables of every kind.
class MatlabFile {
 public:
  MatlabFile(mat_ft version, matio_compression compression) : compression_(compression) {
    file_ = Mat_CreateVer(disk_.path().c_str(), nullptr, version);
    write("row", MAT_C_DOUBLE, MAT_T_DOUBLE, ramp<double>(kSamples), 1, kSamples);
    write("column", MAT_C_DOUBLE, MAT_T_DOUBLE, ramp<double>(kSamples, 0.5), kSamples, 1);
    write("single", MAT_C_SINGLE, MAT_T_SINGLE, ramp<float>(kSamples, 0.25f), 1, kSamples);
    write("int16", MAT_C_INT16, MAT_T_INT16, ramp<std::int16_t>(kSamples, -9), 1, kSamples);
    write("uint8", MAT_C_UINT8, MAT_T_UINT8, ramp<std::uint8_t>(kSamples, 200), 1, kSamples);
    write("int64", MAT_C_INT64, MAT_T_INT64, ramp<std::int64_t>(kSamples, -9), 1, kSamples);
    write("matrix", MAT_C_DOUBLE, MAT_T_DOUBLE, ramp<double>(3 * kSamples), kSamples, 3);
    write("empty", MAT_C_DOUBLE, MAT_T_DOUBLE, std::vector<double>(), 0, 0);
    write("text", MAT_C_CHAR, MAT_T_UINT8, std::string("words"), 1, 5);
    write_struct();
    Mat_Close(file_);
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
  std::string path() const { return disk_.path(); }

 private:
  template <class Values>
  matvar_t* make(const char* name, matio_classes kind, matio_types type, Values values,
                 std::size_t rows, std::size_t columns) {
    std::size_t shape[2] = {rows, columns};
    return Mat_VarCreate(name, kind, type, 2, shape, values.data(), 0);
  }
  template <class Values>
  void write(const char* name, matio_classes kind, matio_types type, Values values,
             std::size_t rows, std::size_t columns) {
    matvar_t* const variable = make(name, kind, type, values, rows, columns);
    Mat_VarWrite(file_, variable, compression_);
    Mat_VarFree(variable);
  }
  void write_struct() {
    const char* outer_fields[] = {"force", "rate"};
    const char* inner_fields[] = {"x"};
    std::size_t one[2] = {1, 1};
    matvar_t* const outer = Mat_VarCreateStruct("run", 2, one, outer_fields, 2);
    matvar_t* const inner = Mat_VarCreateStruct("force", 2, one, inner_fields, 1);
    Mat_VarSetStructFieldByName(
        inner, "x", 0,
        make("x", MAT_C_DOUBLE, MAT_T_DOUBLE, ramp<double>(kSamples, 7.0), 1, kSamples));
    Mat_VarSetStructFieldByName(outer, "force", 0, inner);
    Mat_VarSetStructFieldByName(
        outer, "rate", 0, make("rate", MAT_C_DOUBLE, MAT_T_DOUBLE, ramp<double>(1, 1e4), 1, 1));
    Mat_VarWrite(file_, outer, compression_);
    Mat_VarFree(outer);
  }

  TestFile disk_;
  mat_t* file_ = nullptr;
  matio_compression compression_;
};

struct Kind {
  mat_ft version;
  matio_compression compression;
  const char* format;
};

class Matlab : public testing::TestWithParam<Kind> {};

TEST_P(Matlab, ReadsVectorsOfEveryType) {
  const MatlabFile file(GetParam().version, GetParam().compression);
  EXPECT_EQ(file.read("row").format, GetParam().format);
  EXPECT_EQ(file.samples("row"), ramp_double(kSamples));
  EXPECT_EQ(file.samples("column"), ramp_double(kSamples, 0.5));
  EXPECT_EQ(file.samples("single"), ramp_double(kSamples, 0.25));
  EXPECT_EQ(file.samples("int16"), ramp_double(kSamples, -9));
  EXPECT_EQ(file.samples("uint8"), ramp_double(kSamples, 200));
  EXPECT_EQ(file.samples("int64"), ramp_double(kSamples, -9));
}

TEST_P(Matlab, ReadsColumnsAndRowsOfMatrices) {
  const MatlabFile file(GetParam().version, GetParam().compression);
  EXPECT_EQ(file.samples("matrix(:,2)"), ramp_double(kSamples, kSamples));
  EXPECT_EQ(file.samples("matrix(2,:)"), (std::vector<double>{1, 1 + kSamples, 1 + 2 * kSamples}));
  EXPECT_TRUE(contains(file.fault("matrix(:,4)"), "is not there"));
  EXPECT_TRUE(contains(file.fault("matrix"), "ask for")) << file.fault("matrix");
}

TEST_P(Matlab, ReadsFieldsOfStructs) {
  const MatlabFile file(GetParam().version, GetParam().compression);
  EXPECT_EQ(file.samples("run.force.x"), ramp_double(kSamples, 7.0));
  EXPECT_NE(file.fault("run.force.y"), "");
  EXPECT_NE(file.fault("run.force"), "");
  EXPECT_NE(file.fault("row.x"), "");
}

TEST_P(Matlab, ReadsTimesAndRanges) {
  const MatlabFile file(GetParam().version, GetParam().compression);
  const identify::ChannelSet set =
      read_trace_file(file.path(), {.variables = {{"time", "row"}, {"Fx", "column"}},
                                    .range = TraceSelection::Range{10, 5}})
          .channels;
  EXPECT_EQ(set.time, ramp_double(5, 10.0));
  EXPECT_EQ(set.find("Fx")->samples, ramp_double(5, 10.5));
}

TEST_P(Matlab, SaysWhatIsThereAndWhatIsNoArrayOfNumbers) {
  const MatlabFile file(GetParam().version, GetParam().compression);
  EXPECT_TRUE(contains(file.fault("Fq"), "Fq; it has ")) << file.fault("Fq");
  EXPECT_TRUE(contains(file.fault("Fq"), "int16")) << file.fault("Fq");
  EXPECT_NE(file.fault("text"), "");
  EXPECT_NE(file.fault("empty"), "");
  EXPECT_TRUE(contains(error_text([&] { read_trace_file(file.path()); }), "say which of its"));
  const std::vector<std::string> names = trace_variables(file.path());
  EXPECT_NE(std::find(names.begin(), names.end(), "column"), names.end());
}

INSTANTIATE_TEST_SUITE_P(Versions, Matlab,
                         testing::Values(Kind{MAT_FT_MAT5, MAT_COMPRESSION_NONE, "MATLAB 5"},
                                         Kind{MAT_FT_MAT5, MAT_COMPRESSION_ZLIB, "MATLAB 5"},
                                         Kind{MAT_FT_MAT73, MAT_COMPRESSION_NONE, "MATLAB 7.3"}),
                         [](const testing::TestParamInfo<Kind>& tested) {
                           return std::string(tested.param.version == MAT_FT_MAT73 ? "V73"
                                              : tested.param.compression == MAT_COMPRESSION_NONE
                                                  ? "V5"
                                                  : "V5Compressed");
                         });

TEST(Matlab5, ADamagedFileIsRefusedWhateverItDoesToTheLibrary) {
  const MatlabFile whole(MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  std::ifstream in(whole.path(), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  int refused = 0;
  for (std::size_t at = 128; at < bytes.size() && at < 1200; at += 8) {
    std::string damaged = bytes;
    for (std::size_t i = 0; i < 4; ++i) damaged[at + i] = static_cast<char>(0xff);
    const TestFile file(damaged);
    try {
      const TraceFile read = read_trace_file(file.path(), {.variables = {{"Fx", "single"}}});
      EXPECT_FALSE(read.channels.channels.empty());
    } catch (const core::InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace millstudy::io
