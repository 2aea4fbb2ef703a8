// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "identify/error_text.h"
#include "identify/prepare_trace.h"
#include "io/trace_file.h"
#include "test_file.h"

namespace millstudy::io {
namespace {

/// An export of 20 rows from 8 s on at 10 kHz, in one of the ways that regional settings give.
std::string dynoware(char separator, char decimal, const char* date = "", int samples = 20,
                     const char* number = "{:g}") {
  const auto local = [&](double value) {
    std::string text = fmt::format(fmt::runtime(number), value);
    for (char& c : text) c = c == '.' ? decimal : c;
    return text;
  };
  std::string text =
      "DynoWare,Version 2.5.1.2\nPath:,C:\\data\\\nFilename:,a.dwd\nManipulated:,0\n";
  text += fmt::format("Date:,{}\nTime:,{}\nSampling rate [Hz]:,10000\nMeasuring time [s]:,", date,
                      *date == '\0' ? "" : "14:02:11");
  text += local(0.5) + fmt::format(
                           "\nDelay time [s]:,0\nCycles:,1\nSamples per channel:,{}\n"
                           "Cycle No:,1\nTime,Fx,Fy,Fz\ns,N,N,N\n",
                           samples);
  if (separator != ',') {
    for (char& c : text) c = c == ',' ? separator : c;
    text.replace(text.find("Measuring time [s]:"), 19 + 4,
                 std::string("Measuring time [s]:") + separator + local(0.5));
  }
  for (int i = 0; i < 20; ++i) {
    text += local(8.0 + i * 1e-4) + separator + local(72.6013 + i * i) + separator +
            local(-209.473 + 0.25 * i) + separator + local(-0.000435965 * (i + 1)) + '\n';
  }
  return text;
}

void expect_content(const TraceFile& file, const std::string& which) {
  SCOPED_TRACE(which);
  EXPECT_EQ(file.format, "DynoWare text");
  const identify::ChannelSet& set = file.channels;
  ASSERT_EQ(set.channels.size(), 3u);
  EXPECT_EQ(set.sampling_rate, 10000.0);
  ASSERT_EQ(set.time.size(), 20u);
  EXPECT_EQ(set.time[1], 8.0001);
  EXPECT_EQ(set.channels[0].name, "Fx");
  EXPECT_EQ(set.channels[0].unit, "N");
  for (std::size_t i = 0; i < 20; ++i) {
    const auto k = static_cast<double>(i);
    EXPECT_NEAR(set.channels[0].samples[i], 72.6013 + k * k, 1e-3);
    EXPECT_NEAR(set.channels[1].samples[i], -209.473 + 0.25 * k, 1e-3);
    EXPECT_NEAR(set.channels[2].samples[i], -0.000435965 * (k + 1), 1e-7);
  }
  EXPECT_EQ(set.line_of(0), 15);
}

TEST(Dynoware, ReadsEveryLocale) {
  const struct {
    char separator;
    char decimal;
  } locales[] = {{',', '.'}, {';', '.'}, {';', ','}, {'\t', '.'}, {'\t', ','}, {',', ','}};
  for (const auto [separator, decimal] : locales) {
    for (const char* number : {"{:g}", "{:.7f}"}) {
      const TestFile file(dynoware(separator, decimal, "", 20, number));
      const TraceFile read = read_trace_file(file.path());
      expect_content(
          read, fmt::format("separator {:#x}, decimal {}, {}", int{separator}, decimal, number));
      // What whole numbers leave open between commas is told.
      const bool open = separator == decimal && std::string(number) == "{:g}";
      EXPECT_EQ(read.channels.remarks.size(), open ? 1u : 0u);
    }
  }
}

TEST(Dynoware, TellsThatTheHeaderHasMoreSamplesThanTheFile) {
  const TestFile file(dynoware(',', '.', "", 500001));
  const TraceFile read = read_trace_file(file.path());
  expect_content(read, "partial");
  ASSERT_EQ(read.channels.remarks.size(), 1u);
  EXPECT_EQ(read.channels.remarks[0], "the header says 500001 samples, the file holds 20");
}

TEST(Dynoware, DateAndTimeMayBeBlank) {
  const TestFile blank(dynoware(',', '.'));
  EXPECT_EQ(read_trace_file(blank.path()).channels.recorded, "");
  const TestFile dated(dynoware(';', ',', "15.03.2018"));
  EXPECT_EQ(read_trace_file(dated.path()).channels.recorded, "15.03.2018 14:02:11");
}

TEST(Dynoware, MakesATraceOnTheModelsAxes) {
  const TestFile file(dynoware(',', ','));
  identify::TraceOptions options;
  options.axes = identify::parse_axis_map({"-Fy", "-Fx", "Fz"});
  const identify::PreparedTrace made =
      identify::prepare_trace(read_trace_file(file.path()).channels, options);
  EXPECT_EQ(made.trace.sampling_rate, 10000.0);
  EXPECT_EQ(made.trace.start, 8.0);
  EXPECT_EQ(made.trace.force[0][0], 209.473);
  EXPECT_EQ(made.trace.force[1][0], -72.6013);
}

TEST(Dynoware, AHeaderWithoutRowsIsAFault) {
  const std::string text = dynoware(',', '.');
  const TestFile file(text.substr(0, text.find("8,72")));
  EXPECT_TRUE(
      contains(error_text([&] { read_trace_file(file.path()); }), "has no rows of numbers"));
}

}  // namespace
}  // namespace millstudy::io
