// SPDX-License-Identifier: MIT
#include "identify/time_axis.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>

#include "error_text.h"

namespace millstudy::identify {
namespace {

/// Times as a program prints them, read back.
std::vector<double> printed(const char* format, double start, double rate, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    char text[64];
    std::snprintf(text, sizeof text, format, start + i / rate);
    times.push_back(std::atof(text));
  }
  return times;
}

ChannelSet with_times(std::vector<double> times) {
  ChannelSet set;
  set.source = "a.csv";
  set.time = std::move(times);
  set.lines = {{0, 11}};  // sample 0 is on line 11
  return set;
}

TEST(TimeAxis, FindsTheRateBehindRoundedTimes) {
  for (const char* format : {"%g", "%.4f", "%.9f", "%.17g"}) {
    const TimeAxis axis = fit_time_axis(with_times(printed(format, 8.0, 10000.0, 10001)));
    EXPECT_EQ(axis.sampling_rate, 10000.0) << format;
    EXPECT_EQ(axis.start, 8.0) << format;
  }
  EXPECT_EQ(fit_time_axis(with_times(printed("%.6f", 0.0, 51200.0, 20000))).sampling_rate, 51200.0);
}

TEST(TimeAxis, TakesTimesThatSixDigitsMakeEqual) {
  // At 150 s six digits leave 1 ms: ten samples have the same time.
  const TimeAxis axis = fit_time_axis(with_times(printed("%g", 150.0, 10000.0, 100001)));
  EXPECT_EQ(axis.sampling_rate, 10000.0);
}

TEST(TimeAxis, FindsOneMissingSampleThoughTheTimesAreWholeMilliseconds) {
  std::vector<double> times = printed("%.3f", 0.0, 1000.0, 1000);
  times.erase(times.begin() + 500);
  const std::string text = error_text([&] { fit_time_axis(with_times(times)); });
  EXPECT_TRUE(contains(text, "a.csv:511: time goes from 0.499 to 0.501 s")) << text;
}

TEST(TimeAxis, TakesStepsThatAreNoMultipleOfTheRoundingIfTheRateIsExpected) {
  const ChannelSet set = with_times(printed("%.3f", 0.0, 1050.0, 1000));
  EXPECT_EQ(fit_time_axis(set, 1050.0).sampling_rate, 1050.0);
  EXPECT_NE(error_text([&] { fit_time_axis(set); }), "");
  EXPECT_EQ(fit_time_axis(with_times(printed("%.3f", 0.0, 1700.0, 1000))).sampling_rate, 1700.0);
}

TEST(TimeAxis, TakesSinglePrecision) {
  std::vector<double> times = printed("%.17g", 3.0, 12345.678, 5000);
  for (double& time : times) time = static_cast<float>(time);
  EXPECT_NEAR(fit_time_axis(with_times(times)).sampling_rate, 12345.678, 0.1);
}

TEST(TimeAxis, NamesTheLineOfAGap) {
  std::vector<double> times = printed("%g", 0.0, 1000.0, 100);
  times.erase(times.begin() + 40, times.begin() + 43);
  const std::string text = error_text([&] { fit_time_axis(with_times(times)); });
  EXPECT_TRUE(contains(text, "a.csv:51: time goes from 0.039 to 0.043 s")) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;  // one gap, one fault
}

TEST(TimeAxis, NamesTheLinesOfRepeatedTimesAndOfStepsBack) {
  std::vector<double> times = printed("%g", 0.0, 1000.0, 100);
  times[30] = times[29];
  times[60] = 0.0;
  const std::string text = error_text([&] { fit_time_axis(with_times(times)); });
  EXPECT_TRUE(contains(text, "a.csv:41: time 0.029 s is repeated")) << text;
  EXPECT_TRUE(contains(text, "a.csv:71: time goes back from 0.059 to 0 s")) << text;
}

TEST(TimeAxis, NamesSamplesWhereThereAreNoLines) {
  ChannelSet set = with_times(printed("%g", 0.0, 1000.0, 100));
  set.lines.clear();
  set.time[7] = std::nan("");
  EXPECT_EQ(error_text([&] { fit_time_axis(set); }), "a.csv: sample 7: time nan is no number");
}

TEST(TimeAxis, RefusesARateThatDrifts) {
  std::vector<double> times;
  for (int i = 0; i < 2000; ++i) times.push_back(1e-3 * i + 5e-9 * i * i);
  EXPECT_TRUE(contains(error_text([&] { fit_time_axis(with_times(times)); }), "not constant"));
}

TEST(TimeAxis, RefusesTimesThatStandStill) {
  EXPECT_NE(error_text([] { fit_time_axis(with_times(std::vector<double>(50, 1.0))); }), "");
  EXPECT_NE(error_text([] { fit_time_axis(with_times({1.0})); }), "");
}

TEST(TimeAxis, LimitsItsFaults) {
  std::vector<double> times;
  for (int i = 0; i < 1000; ++i) times.push_back(i % 3 == 0 ? 0.001 * i : 0.001 * i + 0.0005);
  try {
    fit_time_axis(with_times(times));
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.faults().size(), 20u);
  }
}

TEST(TimeAxis, AGivenRateWinsWithAWarningThatNamesBoth) {
  ChannelSet set = with_times(printed("%g", 0.0, 1000.0, 100));
  std::vector<std::string> warnings;
  EXPECT_EQ(find_time_axis(set, 2000.0, warnings).sampling_rate, 2000.0);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "2000 Hz") && contains(warnings[0], "1000 Hz")) << warnings[0];
  warnings.clear();
  find_time_axis(set, 1000.0, warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(TimeAxis, TheTimeColumnWinsOverTheHeaderWithAWarning) {
  ChannelSet set = with_times(printed("%g", 0.0, 1000.0, 100));
  set.sampling_rate = 500.0;
  std::vector<std::string> warnings;
  EXPECT_EQ(find_time_axis(set, {}, warnings).sampling_rate, 1000.0);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "500 Hz") && contains(warnings[0], "1000 Hz")) << warnings[0];
}

TEST(TimeAxis, SaysWhatToGiveWhereNothingSaysTheRate) {
  std::vector<std::string> warnings;
  EXPECT_TRUE(
      contains(error_text([&] { find_time_axis({}, {}, warnings); }), "give sampling_rate_Hz"));
  EXPECT_TRUE(contains(error_text([&] { find_time_axis({}, -1.0, warnings); }),
                       "sampling_rate_Hz = -1 must be > 0"));
}

}  // namespace
}  // namespace millstudy::identify
