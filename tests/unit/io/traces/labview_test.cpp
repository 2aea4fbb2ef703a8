// SPDX-License-Identifier: MIT
#include <algorithm>
#include <gtest/gtest.h>

#include "identify/error_text.h"
#include "io/trace_file.h"
#include "test_file.h"

namespace millstudy::io {
namespace {

/// A header as LabVIEW writes it, with '|' where the separator stands.
std::string header(const std::string& x_columns, const std::string& separator = "Tab",
                   const std::string& decimal = ".") {
  return "LabVIEW Measurement|\nWriter_Version|2\nReader_Version|2\nSeparator|" + separator +
         "\nDecimal_Separator|" + decimal + "\nMulti_Headings|Yes\nX_Columns|" + x_columns +
         "\nTime_Pref|Relative\nOperator|me\nDate|2018/03/"
         "15\nTime|14:02:11\n***End_of_Header***|\n";
}

std::string segment(const std::string& x0, const std::string& names, int samples = 3,
                    const std::string& step = "0.001") {
  const std::string n = std::to_string(samples);
  return "|\nChannels|2|||\nSamples|" + n + '|' + n + "||\nDate|2018/03/15|2018/03/15||\n" +
         "Time|14:02:11|14:02:11||\nY_Unit_Label|N|kN||\nX_Dimension|Time|Time||\nX0|" + x0 + '|' +
         x0 + "||\nDelta_X|" + step + '|' + step + "||\n***End_of_Header***||||\n" + names + "\n";
}

std::string with(std::string text, char separator, char decimal = '.') {
  for (char& c : text) {
    if (c == '|') c = separator;
    if (c == '.' && decimal != '.') c = decimal;
  }
  return text;
}

identify::ChannelSet read(const std::string& text, const TraceSelection& selection = {}) {
  const TestFile file(text);
  const TraceFile read = read_trace_file(file.path(), selection);
  EXPECT_EQ(read.format, "LabVIEW measurement file");
  return read.channels;
}

std::string fault(const std::string& text, const TraceSelection& selection = {}) {
  const TestFile file(text);
  return error_text([&] { read_trace_file(file.path(), selection); });
}

void expect_content(const identify::ChannelSet& set) {
  ASSERT_EQ(set.channels.size(), 2u);
  EXPECT_EQ(set.channels[0].name, "Fx");
  EXPECT_EQ(set.channels[0].unit, "N");
  EXPECT_EQ(set.channels[1].unit, "kN");
  EXPECT_EQ(set.channels[0].samples, (std::vector<double>{1.5, 2.5, 3.5}));
  EXPECT_EQ(set.channels[1].samples, (std::vector<double>{-1, -2, -3}));
  EXPECT_NEAR(set.sampling_rate.value_or(0.0), 1000.0, 1e-9);
  EXPECT_EQ(set.recorded, "2018/03/15 14:02:11");
  EXPECT_TRUE(set.remarks.empty());
}

TEST(Labview, ReadsOneXColumnAndPassesOverComments) {
  const identify::ChannelSet set =
      read(with(header("One") + segment("0.25", "X_Value|Fx|Fy|Comment") +
                    "0.25|1.5|-1|first cut\n0.251|2.5|-2\n0.252|3.5|-3|\n",
                '\t'));
  expect_content(set);
  EXPECT_EQ(set.time, (std::vector<double>{0.25, 0.251, 0.252}));
}

TEST(Labview, ReadsFilesWithoutX) {
  for (const char* first : {"|", ""}) {  // the empty field of X is there or not
    const std::string f = first;
    const identify::ChannelSet set =
        read(with(header("No") + segment("0.25", "X_Value|Fx|Fy|Comment") + f + "1.5|-1\n" + f +
                      "2.5|-2|fine\n" + f + "3.5|-3\n",
                  '\t'));
    expect_content(set);
    EXPECT_TRUE(set.time.empty());
    EXPECT_EQ(set.start, 0.25);
  }
}

TEST(Labview, ReadsAnXColumnForEachChannel) {
  const std::string head = header("Multi") + segment("0", "X_Value|Fx|X_Value|Fy|Comment");
  const identify::ChannelSet set =
      read(with(head + "0|1.5|0|-1\n0.001|2.5|0.001|-2\n0.002|3.5|0.002|-3\n", '\t'));
  expect_content(set);
  EXPECT_EQ(set.time, (std::vector<double>{0, 0.001, 0.002}));
  EXPECT_TRUE(contains(fault(with(head + "0|1.5|0|-1\n0.001|2.5|0.005|-2\n", '\t')),
                       "channels Fx and Fy have different times"));
}

TEST(Labview, ReadsDecimalCommas) {
  const std::string text = header("One", "Tab", ",") + segment("0.25", "X_Value|Fx|Fy|Comment") +
                           "0.25|1.5|-1\n0.251|2.5|-2\n0.252|3.5|-3\n";
  std::string local = with(text, '\t', ',');
  expect_content(read(local));
  local.insert(local.find("Decimal_Separator\t,") + 19, "\t\t");  // some versions fill rows up
  expect_content(read(local));
}

TEST(Labview, ReadsCommasBetweenFields) {
  expect_content(read(with(header("One", "Comma") + segment("0.25", "X_Value|Fx|Fy|Comment") +
                               "0.25|1.5|-1\n0.251|2.5|-2\n0.252|3.5|-3\n",
                           ',')));
}

TEST(Labview, JoinsSegmentsThatFollowOneAnother) {
  const identify::ChannelSet set =
      read(with(header("No") + segment("0", "X_Value|Fx|Fy|Comment", 2) + "|1.5|-1\n|2.5|-2\n" +
                    segment("0.002", "X_Value|Fx|Fy|Comment", 1) + "|3.5|-3\n",
                '\t'));
  expect_content(set);
  EXPECT_TRUE(set.time.empty());
}

TEST(Labview, ShowsTheGapBetweenSegmentsAsTimes) {
  const identify::ChannelSet set =
      read(with(header("No") + segment("0", "X_Value|Fx|Fy|Comment", 2) + "|1.5|-1\n|2.5|-2\n" +
                    segment("7", "X_Value|Fx|Fy|Comment", 1) + "|3.5|-3\n",
                '\t'));
  EXPECT_EQ(set.time, (std::vector<double>{0, 0.001, 7}));
}

TEST(Labview, ReadsOneSegmentOfMany) {
  const std::string text =
      with(header("One") + segment("0", "X_Value|Fx|Fy|Comment") + "0|9|9\n0.001|9|9\n0.002|9|9\n" +
               segment("0", "X_Value|Fx|Fy|Comment") + "0|1.5|-1\n0.001|2.5|-2\n0.002|3.5|-3\n",
           '\t');
  expect_content(read(text, {.segment = 2}));
  EXPECT_TRUE(contains(fault(text, {.segment = 3}), "has 2 segments, there is no segment 3"));
  EXPECT_EQ(read(text).channels[0].samples.size(), 6u);
}

TEST(Labview, PassesOverSpecialBlocks) {
  expect_content(read(with(header("One") + "***Start_Special***|\nTest|1\n***End_Special***|\n" +
                               segment("0.25", "X_Value|Fx|Fy|Comment") +
                               "0.25|1.5|-1\n0.251|2.5|-2\n0.252|3.5|-3\n",
                           '\t')));
}

TEST(Labview, TellsThatASegmentHasOtherSamplesThanItsHeaderSays) {
  const identify::ChannelSet set = read(with(
      header("One") + segment("0", "X_Value|Fx|Fy|Comment", 5000) + "0|1|2\n0.001|3|4\n", '\t'));
  ASSERT_EQ(set.remarks.size(), 1u);
  EXPECT_EQ(set.remarks[0], "the header of segment 1 says 5000 samples, it holds 2");
}

TEST(Labview, ReadsChannelsByNameAndNumber) {
  const std::string text = with(header("One") + segment("0", "X_Value|Fx|Fy|Comment") +
                                    "0|1.5|-1\n0.001|2.5|-2\n0.002|3.5|-3\n",
                                '\t');
  const identify::ChannelSet set = read(text, {.variables = {{"a", "Fy"}, {"b", "1"}}});
  EXPECT_EQ(set.find("a")->samples.front(), -1.0);
  EXPECT_EQ(set.find("b")->samples.front(), 1.5);
  EXPECT_TRUE(contains(fault(text, {.variables = {{"a", "Fq"}}}), "has no column Fq"));
}

TEST(Labview, ReadsARange) {
  const std::string text = with(header("One") + segment("0", "X_Value|Fx|Fy|Comment") +
                                    "0|1.5|-1\n0.001|2.5|-2\n0.002|3.5|-3\n",
                                '\t');
  const identify::ChannelSet set = read(text, {.range = TraceSelection::Range{1, 2}});
  EXPECT_EQ(set.channels[0].samples, (std::vector<double>{2.5, 3.5}));
  EXPECT_EQ(set.time, (std::vector<double>{0.001, 0.002}));
}

TEST(Labview, WithoutAHeaderItIsATableOfNumbers) {
  const TestFile file("0.000\t1.5\t-1\n0.001\t2.5\t-2\n");
  const TraceFile read = read_trace_file(file.path(), {.variables = {{"time", "1"}, {"Fx", "2"}}});
  EXPECT_EQ(read.format, "table of numbers");
  EXPECT_EQ(read.channels.find("Fx")->samples, (std::vector<double>{1.5, 2.5}));
}

TEST(Labview, NamesTheLineOfTextAmongNumbers) {
  const std::string text = fault(with(header("One") + segment("0", "X_Value|Fx|Fy|Comment") +
                                          "0|1.5|-1\n0.001|oops|-2\n0.002|3.5\n",
                                      '\t'));
  EXPECT_TRUE(contains(text, ":25: column Fx = \"oops\" is no number")) << text;
  EXPECT_TRUE(contains(text, ":26: 2 columns, there were 3 before")) << text;
}

TEST(Labview, RefusesAFileThatEndsInAHeader) {
  EXPECT_TRUE(contains(fault("LabVIEW Measurement\t\nSeparator\tTab\n"), "ends within its header"));
  EXPECT_TRUE(contains(fault(with(header("One"), '\t')), "has no segment"));
  const std::string cut = with(header("One") + "|\nChannels|2\nSamples|3\n", '\t');
  EXPECT_TRUE(contains(fault(cut), "ends within the header of a segment"));
}

}  // namespace
}  // namespace millstudy::io
