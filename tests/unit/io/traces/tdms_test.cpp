// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "identify/error_text.h"
#include "io/trace_file.h"
#include "tdms_writer.h"
#include "test_file.h"

namespace millstudy::io {
namespace {

constexpr std::uint32_t kDouble = 10, kFloat = 9, kInt16 = 2, kInt32 = 3, kText = 0x20;
constexpr std::uint32_t kAll = kTdmsMeta | kTdmsNew | kTdmsRaw;
const std::string kFx = "/'run'/'Fx'";
const std::string kFy = "/'run'/'Fy'";

identify::ChannelSet read(const std::string& bytes, const TraceSelection& selection = {}) {
  const TestFile file(bytes);
  const TraceFile read = read_trace_file(file.path(), selection);
  EXPECT_EQ(read.format, "NI TDMS");
  return read.channels;
}

std::string fault(const std::string& bytes, const TraceSelection& selection = {}) {
  const TestFile file(bytes);
  return error_text([&] { read_trace_file(file.path(), selection); });
}

/// Metadata of a root, a group, Fx as doubles and Fy as 16-bit integers, `count` of each a chunk.
std::string two_channels(std::uint64_t count, bool big_endian = false) {
  TdmsBytes m(big_endian);
  m.u32(4);
  m.object_without_data("/").u32(1).property("name", std::string("test"));
  m.object_without_data("/'run'").u32(0);
  m.object(kFx, kDouble, count).u32(2);
  m.property("wf_increment", 1e-4).property("unit_string", std::string("N"));
  m.object(kFy, kInt16, count).u32(1).property("wf_increment", 1e-4);
  return m.bytes();
}

std::string doubles(const std::vector<double>& values, bool big_endian = false) {
  TdmsBytes b(big_endian);
  for (const double value : values) b.number(value);
  return b.bytes();
}

std::string shorts(const std::vector<int>& values, bool big_endian = false) {
  TdmsBytes b(big_endian);
  for (const int value : values) b.number(static_cast<std::int16_t>(value));
  return b.bytes();
}

void expect_two(const identify::ChannelSet& set, const std::vector<double>& fx,
                const std::vector<double>& fy) {
  ASSERT_EQ(set.channels.size(), 2u);
  EXPECT_EQ(set.channels[0].name, "run/Fx");
  EXPECT_EQ(set.channels[0].unit, "N");
  EXPECT_EQ(set.channels[0].samples, fx);
  EXPECT_EQ(set.channels[1].samples, fy);
  EXPECT_DOUBLE_EQ(set.sampling_rate.value_or(0.0), 10000.0);
}

TEST(Tdms, ReadsContiguousDataOfBothVersionsAndByteOrders) {
  for (const std::uint32_t version : {4712u, 4713u}) {
    for (const bool big : {false, true}) {
      expect_two(read(tdms_segment(kAll | (big ? kTdmsBig : 0), two_channels(3, big),
                                   doubles({1, 2, 3}, big) + shorts({-4, -5, -6}, big), version)),
                 {1, 2, 3}, {-4, -5, -6});
    }
  }
}

TEST(Tdms, ReadsInterleavedDataOfBothByteOrders) {
  for (const bool big : {false, true}) {
    std::string raw;
    for (int i = 0; i < 3; ++i) raw += doubles({1.0 + i}, big) + shorts({-4 - i}, big);
    expect_two(read(tdms_segment(kAll | kTdmsInterleaved | (big ? kTdmsBig : 0),
                                 two_channels(3, big), raw)),
               {1, 2, 3}, {-4, -5, -6});
  }
}

TEST(Tdms, ReadsEveryTypeOfNumber) {
  TdmsBytes m;
  TdmsBytes raw;
  m.u32(10);
  std::vector<double> expected;
  const auto add = [&]<class T>(std::uint32_t type, T value) {
    m.object("/'g'/'c" + std::to_string(type) + "'", type, 1).u32(0);
    raw.number(value);
    expected.push_back(static_cast<double>(value));
  };
  add(1, std::int8_t{-100});
  add(2, std::int16_t{-30000});
  add(3, std::int32_t{-2000000000});
  add(4, std::int64_t{-4000000000000});
  add(5, std::uint8_t{200});
  add(6, std::uint16_t{60000});
  add(7, std::uint32_t{4000000000});
  add(8, std::uint64_t{8000000000000});
  add(9, 1.5f);
  add(10, -2.5e-300);
  const identify::ChannelSet set = read(tdms_segment(kAll, m.bytes(), raw.bytes()));
  ASSERT_EQ(set.channels.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(set.channels[i].samples, std::vector<double>{expected[i]}) << set.channels[i].name;
  }
}

TEST(Tdms, ReadsRepeatedChunksAndSegmentsWithoutMetadata) {
  const std::string chunk1 = doubles({1, 2}) + shorts({10, 20});
  const std::string chunk2 = doubles({3, 4}) + shorts({30, 40});
  const std::string chunk3 = doubles({5, 6}) + shorts({50, 60});
  expect_two(read(tdms_segment(kAll, two_channels(2), chunk1 + chunk2) +
                  tdms_segment(kTdmsRaw, "", chunk3)),
             {1, 2, 3, 4, 5, 6}, {10, 20, 30, 40, 50, 60});
}

TEST(Tdms, ReadsIncrementalMetadata) {
  const std::string first = tdms_segment(kAll, two_channels(2), doubles({1, 2}) + shorts({10, 20}));
  // Fx changes its length, Fy stays; a property changes.
  TdmsBytes change;
  change.u32(1).object(kFx, kDouble, 1).u32(1).property("unit_string", std::string("N"));
  const std::string second =
      tdms_segment(kTdmsMeta | kTdmsRaw, change.bytes(), doubles({3}) + shorts({30, 40}));
  // A new list of one channel, as before.
  TdmsBytes list;
  list.u32(1).object_as_before(kFy).u32(0);
  const std::string third = tdms_segment(kAll, list.bytes(), shorts({50, 60}));
  // Fx comes back, as it was last; Fy has no data here.
  TdmsBytes back;
  back.u32(2).object_as_before(kFx).u32(0).object_without_data(kFy).u32(0);
  const std::string fourth = tdms_segment(kTdmsMeta | kTdmsRaw, back.bytes(), doubles({4}));
  expect_two(read(first + second + third + fourth), {1, 2, 3, 4}, {10, 20, 30, 40, 50, 60});
}

TEST(Tdms, AppliesLinearAndPolynomialScales) {
  TdmsBytes m;
  m.u32(3);
  m.object(kFx, kInt16, 2).u32(5);
  m.property("NI_Scaling_Status", std::string("unscaled")).property("NI_Number_Of_Scales", 2u);
  // Scale 0 is the raw data of the device, as DAQmx writes it: it has no type.
  m.property("NI_Scale[1]_Scale_Type", std::string("Linear"));
  m.property("NI_Scale[1]_Linear_Slope", 0.5).property("NI_Scale[1]_Linear_Y_Intercept", -1.0);
  m.object(kFy, kInt32, 2).u32(9);
  m.property("NI_Scale[0]_Scale_Type", std::string("Linear"));
  m.property("NI_Scale[0]_Linear_Slope", 2.0).property("NI_Scale[0]_Linear_Y_Intercept", 1.0);
  m.property("NI_Scale[0]_Linear_Input_Source", 0xffffffffu);
  m.property("NI_Scale[1]_Scale_Type", std::string("Polynomial"));
  m.property("NI_Scale[1]_Polynomial_Coefficients_Size", 2u);
  m.property("NI_Scale[1]_Polynomial_Coefficients[0]", 100.0);
  m.property("NI_Scale[1]_Polynomial_Coefficients[1]", 10.0);
  m.property("NI_Scale[1]_Polynomial_Input_Source", 0u);
  m.object("/'run'/'done'", kInt16, 2).u32(4);
  m.property("NI_Scaling_Status", std::string("scaled"));
  m.property("NI_Scale[0]_Scale_Type", std::string("Linear"));
  m.property("NI_Scale[0]_Linear_Slope", 2.0).property("NI_Scale[0]_Linear_Y_Intercept", 1.0);
  TdmsBytes y;
  y.number(std::int32_t{3}).number(std::int32_t{4});
  const identify::ChannelSet set =
      read(tdms_segment(kAll, m.bytes(), shorts({10, 20}) + y.bytes() + shorts({10, 20})));
  EXPECT_EQ(set.find("run/Fx")->samples, (std::vector<double>{4, 9}));
  EXPECT_EQ(set.find("run/Fy")->samples, (std::vector<double>{170, 190}));
  EXPECT_EQ(set.find("run/done")->samples, (std::vector<double>{10, 20}));
}

TEST(Tdms, FindsChannelsByPathOrName) {
  const std::string file = tdms_segment(kAll, two_channels(2), doubles({1, 2}) + shorts({10, 20}));
  const identify::ChannelSet set = read(file, {.variables = {{"a", "Fy"}, {"b", "run/Fx"}}});
  EXPECT_EQ(set.find("a")->samples, (std::vector<double>{10, 20}));
  EXPECT_EQ(set.find("b")->samples, (std::vector<double>{1, 2}));
  EXPECT_TRUE(contains(fault(file, {.variables = {{"a", "Fq"}}}),
                       "has no channel Fq; it has run/Fx, run/Fy"));
  const TestFile disk(file);
  EXPECT_EQ(trace_variables(disk.path()), (std::vector<std::string>{"run/Fx", "run/Fy"}));
}

TEST(Tdms, UnderstandsQuotesInNames) {
  TdmsBytes m;
  m.u32(1).object("/'Dr. T''s /run'/'F''x'", kDouble, 1).u32(0);
  EXPECT_EQ(read(tdms_segment(kAll, m.bytes(), doubles({1}))).channels[0].name, "Dr. T's /run/F'x");
}

TEST(Tdms, RefusesTextsAndDaqmxDataWhereTheyAreAskedFor) {
  TdmsBytes m;
  m.u32(2).object(kFx, kDouble, 1).u32(0);
  m.text("/'run'/'note'").u32(28).u32(kText).u32(1).u64(1).u64(4 + 5).u32(0);
  TdmsBytes note;
  note.u32(5);
  const std::string file = tdms_segment(kAll, m.bytes(), doubles({1}) + note.bytes() + "words");
  EXPECT_EQ(read(file, {.variables = {{"Fx", "Fx"}}}).channels[0].samples, std::vector<double>{1});
  EXPECT_TRUE(
      contains(fault(file, {.variables = {{"Fx", "note"}}}), "channel run/note holds no numbers"));

  TdmsBytes d;
  d.u32(1).text(kFx).u32(0x1269).u32(0xffffffff).u32(1).u64(2).u32(1);
  d.u32(3).u32(0).u32(0).u32(0).u32(0).u32(1).u32(2).u32(0);
  EXPECT_TRUE(contains(fault(tdms_segment(kAll | kTdmsDaqmx, d.bytes(), shorts({1, 2}))),
                       "holds raw data of a DAQmx device"));
}

TEST(Tdms, RefusesScalesItDoesNotKnow) {
  TdmsBytes m;
  m.u32(1).object(kFx, kDouble, 1).u32(1);
  m.property("NI_Scale[0]_Scale_Type", std::string("Thermocouple"));
  EXPECT_TRUE(contains(fault(tdms_segment(kAll, m.bytes(), doubles({1}))),
                       "a scale of the type Thermocouple; Linear and Polynomial can be read"));
}

TEST(Tdms, ReadsWhatThereIsOfAFileThatWasNotFinished) {
  const std::string raw = doubles({1, 2}) + shorts({10, 20}) + doubles({3});
  for (const std::uint64_t length : {~std::uint64_t{0}, std::uint64_t{100000}}) {
    const identify::ChannelSet set = read(tdms_segment(kAll, two_channels(2), raw, 4713, length));
    expect_two(set, {1, 2}, {10, 20});
    EXPECT_EQ(set.remarks.size(), 2u);
  }
}

TEST(Tdms, RefusesDamagedFiles) {
  const std::string good = tdms_segment(kAll, two_channels(2), doubles({1, 2}) + shorts({10, 20}));
  EXPECT_TRUE(
      contains(fault(good + "junkjunkjunkjunkjunkjunkjunkjunk"), "no TDMS segment begins at"));
  EXPECT_TRUE(
      contains(fault(tdms_segment(kAll, two_channels(2), "", 5000)), "version 5000 is unknown"));
  EXPECT_TRUE(contains(fault(tdms_segment(kAll, "\x05", "")), "is cut off or damaged"));
  TdmsBytes m;
  m.u32(1).object_as_before(kFx).u32(0);
  EXPECT_TRUE(contains(fault(tdms_segment(kAll, m.bytes(), "")), "has no index of its data"));
  TdmsBytes huge;
  huge.u32(1).object(kFx, kDouble, ~std::uint64_t{0} / 4).u32(0);
  EXPECT_NE(fault(tdms_segment(kAll, huge.bytes(), doubles({1}))), "");
}

TEST(Tdms, RefusesChannelsOfDifferentRates) {
  TdmsBytes m;
  m.u32(2).object(kFx, kDouble, 1).u32(1).property("wf_increment", 1e-4);
  m.object(kFy, kDouble, 1).u32(1).property("wf_increment", 1e-3);
  EXPECT_TRUE(contains(fault(tdms_segment(kAll, m.bytes(), doubles({1, 2}))), "another 10000 Hz"));
}

TEST(Tdms, ReadsARange) {
  TdmsBytes m;
  m.u32(1).object(kFx, kFloat, 4).u32(2).property("wf_increment", 0.5);
  m.property("wf_start_offset", 10.0);
  TdmsBytes raw;
  for (const float v : {1.f, 2.f, 3.f, 4.f}) raw.number(v);
  const identify::ChannelSet set =
      read(tdms_segment(kAll, m.bytes(), raw.bytes()), {.range = TraceSelection::Range{1, 2}});
  EXPECT_EQ(set.channels[0].samples, (std::vector<double>{2, 3}));
  EXPECT_EQ(set.start, 10.5);
}

}  // namespace
}  // namespace millstudy::io
