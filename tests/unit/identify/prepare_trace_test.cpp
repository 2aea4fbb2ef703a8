// SPDX-License-Identifier: MIT
#include "identify/prepare_trace.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "error_text.h"

namespace millstudy::identify {
namespace {

constexpr double kRate = 1000.0;

/// Three channels of 100 samples on lines 5 to 104, Fx = i, Fy = 1000 + i, Fz = -i, starting at 2
/// s.
ChannelSet ramps() {
  ChannelSet set;
  set.source = "a.csv";
  set.sampling_rate = kRate;
  set.start = 2.0;
  set.lines = {{0, 5}};
  set.channels = {{"Fx", "N", {}}, {"Fy", "N", {}}, {"Fz", "N", {}}};
  for (int i = 0; i < 100; ++i) {
    set.channels[0].samples.push_back(i);
    set.channels[1].samples.push_back(1000.0 + i);
    set.channels[2].samples.push_back(-i);
  }
  return set;
}

TraceOptions options(const std::string& x, const std::string& y, const std::string& z) {
  TraceOptions options;
  options.axes = parse_axis_map({x, y, z});
  return options;
}

std::string fault_of(const ChannelSet& set, const TraceOptions& with) {
  return error_text([&] { prepare_trace(set, with); });
}

TEST(PrepareTrace, PutsChannelsOnTheAxesWithTheirSigns) {
  const PreparedTrace made = prepare_trace(ramps(), options("-Fy", "-Fx", "Fz"));
  EXPECT_TRUE(made.warnings.empty());
  EXPECT_EQ(made.trace.size(), 100u);
  EXPECT_EQ(made.trace.sampling_rate, kRate);
  EXPECT_EQ(made.trace.start, 2.0);
  EXPECT_EQ(made.trace.force[0][7], -1007.0);
  EXPECT_EQ(made.trace.force[1][7], -7.0);
  EXPECT_EQ(made.trace.force[2][7], -7.0);
}

TEST(PrepareTrace, LeavesAnAxisEmptyThatWasNotMeasured) {
  const Trace trace = prepare_trace(ramps(), options("Fx", "Fy", "")).trace;
  EXPECT_TRUE(trace.has_axis(1));
  EXPECT_FALSE(trace.has_axis(2));
}

TEST(PrepareTrace, TheWindowTakesItsFirstTimeAndLeavesItsLast) {
  TraceOptions with = options("Fx", "", "");
  with.window = TimeWindow{2.01, 2.05};
  const Trace trace = prepare_trace(ramps(), with).trace;
  ASSERT_EQ(trace.size(), 40u);
  EXPECT_EQ(trace.force[0].front(), 10.0);
  EXPECT_EQ(trace.force[0].back(), 49.0);
  EXPECT_NEAR(trace.start, 2.01, 1e-12);
  with.window = TimeWindow{2.0, 2.1};  // all: the record ends where the next sample would be
  EXPECT_EQ(prepare_trace(ramps(), with).trace.size(), 100u);
}

TEST(PrepareTrace, RefusesAWindowOutsideOfTheRecordSayingWhereThatIs) {
  for (const TimeWindow window :
       {TimeWindow{0.0, 1.0}, TimeWindow{1.99, 2.05}, TimeWindow{2.05, 2.101}}) {
    TraceOptions with = options("Fx", "", "");
    with.window = window;
    EXPECT_TRUE(contains(fault_of(ramps(), with), "which goes from 2 to 2.1 s"));
  }
  TraceOptions with = options("Fx", "", "");
  with.window = TimeWindow{2.05, 2.01};
  EXPECT_TRUE(contains(fault_of(ramps(), with), "must go from a time to a later one"));
  with.window = TimeWindow{std::nan(""), 2.01};
  EXPECT_TRUE(contains(fault_of(ramps(), with), "must go from a time to a later one"));
}

TEST(PrepareTrace, RefusesARecordThatIsTooLongButTakesAPartOfIt) {
  ChannelSet set = ramps();
  set.channels.resize(1);
  set.channels[0].samples.assign(kMostSamples + 1, 1.0);
  set.channels[0].samples[3] = 2.0;
  EXPECT_EQ(fault_of(set, options("Fx", "", "")),
            "a.csv: 10000001 samples, 1e+04 s, are more than 10000000: take a part of them, by "
            "window_s = [from, to]; some hundred revolutions say all");
  TraceOptions part = options("Fx", "", "");
  part.window = TimeWindow{2.0, 3.0};
  EXPECT_EQ(prepare_trace(set, part).trace.size(), 1000u);
}

TEST(PrepareTrace, ConvertsUnitsOfTheFileAndOfTheKey) {
  ChannelSet set = ramps();
  set.channels[0].unit = "kN";
  set.channels[1].unit = "mV";
  TraceOptions with = options("Fx", "-Fy", "Fz");
  with.sensitivity_N_per_V = {{"Fy", 200.0}};
  with.units = {{"Fz", "lbf"}};
  const Trace trace = prepare_trace(set, with).trace;
  EXPECT_DOUBLE_EQ(trace.force[0][3], 3000.0);
  EXPECT_DOUBLE_EQ(trace.force[1][3], -200.6);
  EXPECT_DOUBLE_EQ(trace.force[2][3], -3.0 * 4.4482216152605);
}

TEST(PrepareTrace, AUnitForAllIsForChannelsWithoutOne) {
  TraceOptions with = options("Fx", "Fy", "");
  with.units = {{"", "kN"}, {"Fy", "N"}};
  const Trace trace = prepare_trace(ramps(), with).trace;
  EXPECT_EQ(trace.force[0][3], 3000.0);
  EXPECT_EQ(trace.force[1][3], 1003.0);
}

TEST(PrepareTrace, SaysWhatToWriteForUnitsItCannotConvert) {
  ChannelSet set = ramps();
  set.channels[0].unit = "Nm";
  set.channels[1].unit = "V";
  const std::string text = fault_of(set, options("Fx", "Fy", ""));
  EXPECT_TRUE(contains(text, "channel Fx has the unit \"Nm\": a force is in N, daN, kN")) << text;
  EXPECT_TRUE(contains(text, "channel Fy is in V: give sensitivity_N_per_V")) << text;
  TraceOptions with = options("Fy", "", "");
  with.sensitivity_N_per_V = {{"", 0.0}};
  EXPECT_TRUE(contains(fault_of(set, with), "must be a number other than 0"));
}

TEST(PrepareTrace, TakesNewtonWithAWarningWhereNothingSaysTheUnit) {
  ChannelSet set = ramps();
  set.channels[0].unit = "";
  const PreparedTrace made = prepare_trace(set, options("Fx", "", ""));
  EXPECT_EQ(made.trace.force[0][3], 3.0);
  ASSERT_EQ(made.warnings.size(), 1u);
  EXPECT_EQ(made.warnings[0], "channel Fx has no unit: it is taken as N");
}

TEST(PrepareTrace, PassesRemarksOfTheFileOn) {
  ChannelSet set = ramps();
  set.remarks = {"the header says more"};
  EXPECT_EQ(prepare_trace(set, options("Fx", "", "")).warnings, set.remarks);
}

TEST(PrepareTrace, NamesRunsOfNaNByTheirLines) {
  ChannelSet set = ramps();
  for (int i = 20; i < 25; ++i) set.channels[0].samples[i] = std::nan("");
  set.channels[0].samples[50] = std::numeric_limits<double>::infinity();
  const std::string text = fault_of(set, options("Fx", "", ""));
  EXPECT_EQ(text,
            "a.csv:25: channel Fx is nan for 5 samples, to line 29\na.csv:55: channel Fx is inf");
  set.lines.clear();
  EXPECT_TRUE(contains(fault_of(set, options("Fx", "", "")),
                       "a.csv: channel Fx, sample 20: is nan for 5 samples, to sample 24"));
}

TEST(PrepareTrace, DoesNotMindNaNOutsideOfTheWindow) {
  ChannelSet set = ramps();
  set.channels[0].samples[0] = std::nan("");
  TraceOptions with = options("Fx", "", "");
  with.window = TimeWindow{2.05, 2.1};
  EXPECT_EQ(prepare_trace(set, with).trace.size(), 50u);
}

TEST(PrepareTrace, WarnsOfClippedChannelsButNotOfZeroForce) {
  ChannelSet set = ramps();
  for (int i = 60; i < 80; ++i) set.channels[0].samples[i] = 99.0;
  for (int i = 0; i < 50; ++i) set.channels[2].samples[i] = 0.0;
  const PreparedTrace made = prepare_trace(set, options("Fx", "Fy", "Fz"));
  ASSERT_EQ(made.warnings.size(), 1u) << made.warnings[1];
  EXPECT_TRUE(
      contains(made.warnings[0],
               "channel Fx is 99 in 21 % of the samples, up to 20 in a row, and never more"))
      << made.warnings[0];
}

TEST(PrepareTrace, WarnsOfAConstantChannel) {
  ChannelSet set = ramps();
  set.channels[1].samples.assign(100, 3.0);
  const PreparedTrace made = prepare_trace(set, options("Fx", "Fy", ""));
  ASSERT_EQ(made.warnings.size(), 1u);
  EXPECT_TRUE(contains(made.warnings[0], "channel Fy is 3 throughout"));
}

TEST(PrepareTrace, RefusesShortRecordsUnequalColumnsAndMissingChannels) {
  ChannelSet set = ramps();
  set.channels[1].samples.pop_back();
  EXPECT_TRUE(contains(fault_of(set, options("Fx", "Fy", "")),
                       "channel Fy has 99 samples, another has 100"));
  set.channels[0].samples.clear();
  EXPECT_TRUE(
      contains(fault_of(set, options("Fx", "Fy", "")), "channel Fy has 99 samples, another has 0"));
  EXPECT_TRUE(contains(fault_of(set, options("Fx", "F7", "F8")), "no channel F7 for axis y"));
  EXPECT_TRUE(contains(fault_of(set, options("Fx", "F7", "F8")), "no channel F8 for axis z"));
  set = ramps();
  set.channels[0].samples.resize(15);
  EXPECT_TRUE(contains(fault_of(set, options("Fx", "", "")),
                       "15 samples are too few: there must be at least 16"));
  set = ramps();
  set.time = {0.0, 1.0};
  EXPECT_TRUE(contains(fault_of(set, options("Fx", "", "")), "2 times for 100 samples"));
  set.channels.clear();
  EXPECT_TRUE(contains(fault_of(set, options("Fx", "", "")), "no channel Fx"));
}

TEST(ChannelSet, FindsLinesAcrossBlankOnes) {
  ChannelSet set;
  EXPECT_EQ(set.line_of(3), 0);
  set.lines = {{0, 5}, {10, 17}};
  EXPECT_EQ(set.line_of(0), 5);
  EXPECT_EQ(set.line_of(9), 14);
  EXPECT_EQ(set.line_of(10), 17);
}

}  // namespace
}  // namespace millstudy::identify
