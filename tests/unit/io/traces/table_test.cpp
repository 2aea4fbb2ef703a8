// SPDX-License-Identifier: MIT
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "identify/error_text.h"
#include "io/trace_file.h"
#include "io/traces/split_numbers.h"
#include "io/traces/text_dialect.h"
#include "test_file.h"

namespace millstudy::io {
namespace {

TraceFile read(const std::string& text, const TraceSelection& selection = {}) {
  const TestFile file(text);
  return read_trace_file(file.path(), selection);
}

std::string fault(const std::string& text, const TraceSelection& selection = {}) {
  const TestFile file(text);
  const std::string said = error_text([&] { read_trace_file(file.path(), selection); });
  // Without the folder.
  std::string shown;
  std::size_t at = 0;
  for (std::size_t found; (found = said.find(file.path(), at)) != std::string::npos;) {
    shown += said.substr(at, found - at) + "FILE";
    at = found + file.path().size();
  }
  return shown + said.substr(at);
}

void expect_columns(const TraceFile& file, const std::vector<double>& fx,
                    const std::vector<double>& fy, const std::string& which) {
  SCOPED_TRACE(which);
  const identify::Channel* x = file.channels.find("Fx");
  const identify::Channel* y = file.channels.find("Fy");
  ASSERT_NE(x, nullptr);
  ASSERT_NE(y, nullptr);
  EXPECT_EQ(x->samples, fx);
  EXPECT_EQ(y->samples, fy);
}

TEST(TableOfNumbers, ReadsEverySeparatorAndDecimalSign) {
  for (const std::string text :
       {"Fx,Fy\n1.5,-2\n2.5,3e-1\n", "Fx;Fy\n1.5;-2\n2.5;3e-1\n", "Fx;Fy\n1,5;-2\n2,5;3e-1\n",
        "Fx\tFy\n1.5\t-2\n2.5\t3e-1\n", "Fx\tFy\n1,5\t-2\n2,5\t3e-1\n", "Fx Fy\n1.5 -2\n2.5 3e-1\n",
        "  Fx   Fy\n  1.5   -2\n  2.5  3e-1\n", "Fx Fy\n1,5 -2\n2,5 3e-1\n",
        "Fx, Fy\n1.5, -2\n2.5, 3e-1\n", "Fx,Fy\n1.5,-2,\n2.5,3e-1,\n",
        "\xef\xbb\xbf"
        "Fx,Fy\r\n1.5,-2\r\n2.5,3e-1",
        "\"Fx\",\"Fy\"\n\"1.5\",\"-2\"\n2.5,+3E-01\n", "# Fx Fy\n1.5,-2\n\n# pause\n2.5,0.3\n",
        "% made by hand\n% Fx\tFy\n1.5\t-2\n2.5\t.3\n", "Fx Fy\n1.5 -2 \t\n2.5 \t 0.3\n"}) {
    expect_columns(read(text), {1.5, 2.5}, {-2.0, 0.3}, text);
  }
}

TEST(TableOfNumbers, ReadsDecimalCommasThatOnlyLaterRowsShow) {
  expect_columns(read("Fx;Fy\n1;-2\n2;3\n2,5;0,3\n"), {1, 2, 2.5}, {-2, 3, 0.3}, "semicolons");
}

TEST(TableOfNumbers, ReadsUnitsInBracketsOrOnTheirOwnLine) {
  for (const char* text :
       {"t [ms],Fx [kN],Fy (mV)\n0,1,2\n1,3,4\n", "t,Fx,Fy\nms,kN,mV\n0,1,2\n1,3,4\n",
        "t,Fx,Fy\n[ms],[kN],[mV]\n0,1,2\n1,3,4\n", "t Fx Fy\n(ms) (kN) (mV)\n0 1 2\n1 3 4\n",
        "t [ms] Fx [kN] Fy [mV]\n0 1 2\n1 3 4\n"}) {
    SCOPED_TRACE(text);
    const identify::ChannelSet set = read(text).channels;
    ASSERT_EQ(set.channels.size(), 2u);
    EXPECT_EQ(set.channels[0].name, "Fx");
    EXPECT_EQ(set.channels[0].unit, "kN");
    EXPECT_EQ(set.channels[1].unit, "mV");
    EXPECT_EQ(set.time, (std::vector<double>{0.0, 1e-3}));
  }
}

TEST(TableOfNumbers, ReadsColumnsByNameByAnyCaseAndByNumber) {
  const std::string text = "time,Fx,Fy,Fz\n0,1,2,3\n0.5,4,5,6\n";
  const identify::ChannelSet set =
      read(text, {.variables = {{"a", "Fz"}, {"b", "fy"}, {"c", "2"}}}).channels;
  ASSERT_EQ(set.channels.size(), 3u);
  EXPECT_EQ(set.find("a")->samples, (std::vector<double>{3, 6}));
  EXPECT_EQ(set.find("b")->samples, (std::vector<double>{2, 5}));
  EXPECT_EQ(set.find("c")->samples, (std::vector<double>{1, 4}));
  EXPECT_EQ(set.time, (std::vector<double>{0, 0.5}));
}

TEST(TableOfNumbers, WithoutHeadingsColumnsGoByNumber) {
  const identify::ChannelSet set =
      read("0 1 2\n0.5 3 4\n1 5 6\n", {.variables = {{"Fx", "3"}, {"time", "1"}}}).channels;
  EXPECT_EQ(set.find("Fx")->samples, (std::vector<double>{2, 4, 6}));
  EXPECT_EQ(set.time, (std::vector<double>{0, 0.5, 1}));
}

TEST(TableOfNumbers, NamesTheColumnsThereAreWhereOneIsMissing) {
  EXPECT_EQ(fault("Fx,Fy\n1,2\n3,4\n", {.variables = {{"Fx", "Fq"}}}),
            "FILE: has no column Fq; it has 2: Fx, Fy");
  EXPECT_EQ(fault("Fx,Fy\n1,2\n3,4\n", {.variables = {{"Fx", "3"}}}),
            "FILE: has no column 3; it has 2: Fx, Fy");
  EXPECT_EQ(fault("Fx,Fx\n1,2\n3,4\n", {.variables = {{"Fx", "Fx"}}}),
            "FILE: columns 1 and 2 are both called Fx: give a number");
}

TEST(TableOfNumbers, NamesTheLineOfTextAmongNumbers) {
  EXPECT_EQ(fault("Fx,Fy\n1,2\n3,4\n5,overload\n7,8\n1.2.3,4\n"),
            "FILE:4: column Fy = \"overload\" is no number\n"
            "FILE:6: column Fx = \"1.2.3\" is no number");
}

TEST(TableOfNumbers, DoesNotMindTextInColumnsThatAreNotAskedFor) {
  EXPECT_EQ(read("Fx,Fy\n1,2\n3,4\n5,overload\n", {.variables = {{"Fx", "Fx"}}})
                .channels.find("Fx")
                ->samples,
            (std::vector<double>{1, 3, 5}));
}

TEST(TableOfNumbers, NamesTheLinesOfUnequalRows) {
  EXPECT_EQ(fault("Fx,Fy\n1,2\n3,4\n5\n7,8,9\n1,2\n"),
            "FILE:4: 1 columns, there were 2 before\nFILE:5: 3 columns, there were 2 before");
  EXPECT_EQ(fault("Fx,Fy\n1,2\n3,4\n5,\n1,\"\"\n7,8\n"),
            "FILE:4: 1 columns, there were 2 before\nFILE:5: 1 columns, there were 2 before");
  EXPECT_EQ(fault("Fx,Fy,Fz\n1,2,3\n3,4,5\n5,,6\n7,8,9\n"), "FILE:4: column Fy is empty");
}

TEST(TableOfNumbers, LeavesOutALastLineThatIsCutOff) {
  const identify::ChannelSet set = read("Fx,Fy\n1,2\n3,4\n5").channels;
  EXPECT_EQ(set.find("Fx")->samples, (std::vector<double>{1, 3}));
  ASSERT_EQ(set.remarks.size(), 1u);
  EXPECT_EQ(set.remarks[0], "the end of the file cuts line 4 off: it is left out");
}

TEST(TableOfNumbers, StopsAfterTwentyFaults) {
  std::string text = "Fx,Fy\n1,2\n3,4\n";
  for (int i = 0; i < 100; ++i) text += "x,1\n";
  const TestFile file(text);
  try {
    read_trace_file(file.path());
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.faults().size(), 20u);
  }
}

TEST(TableOfNumbers, KeepsNaNForTheCheckOfTheTrace) {
  const identify::ChannelSet set = read("Fx\n1\nNaN\n3\n").channels;
  EXPECT_TRUE(std::isnan(set.find("Fx")->samples[1]));
}

TEST(TableOfNumbers, KnowsTheLineOfEverySample) {
  const identify::ChannelSet set = read("Fx\n# why\n1\n2\n\n# pause\n3\n4\n").channels;
  EXPECT_EQ(set.line_of(0), 3);
  EXPECT_EQ(set.line_of(1), 4);
  EXPECT_EQ(set.line_of(2), 7);
  EXPECT_EQ(set.line_of(3), 8);
}

TEST(TableOfNumbers, ReadsARange) {
  const TraceSelection some{.variables = {{"Fx", "Fx"}}, .range = TraceSelection::Range{1, 2}};
  const identify::ChannelSet set = read("Fx\n1\n2\n3\n4\n", some).channels;
  EXPECT_EQ(set.channels[0].samples, (std::vector<double>{2, 3}));
  EXPECT_EQ(set.line_of(0), 3);
  EXPECT_TRUE(contains(fault("Fx\n1\n2\n", some), "does not have samples 1 ... 2"));
  EXPECT_TRUE(
      contains(fault("Fx\n1\n2\n", {.range = TraceSelection::Range{-1, 2}}), "must be >= 0"));
}

TEST(TableOfNumbers, TakesHeadersWithNumbersInThem) {
  expect_columns(read("machine 7\n12\nFx,Fy\n1,2\n3,4\n"), {1, 3}, {2, 4},
                 "a line that is a number");
}

TEST(TraceFile, SaysWhatAFileIsThatIsNoTrace) {
  EXPECT_EQ(fault(""), "FILE: cannot be read: it is empty");
  EXPECT_TRUE(
      contains(fault("just words\nand more\n"), "has no rows of numbers in its first 2 lines"));
  EXPECT_TRUE(contains(fault("PK\x03\x04zip"), "an Excel workbook"));
  EXPECT_TRUE(contains(fault("\x1f\x8b\x08gzip"), "compressed by gzip"));
  EXPECT_TRUE(contains(fault("TDSh" + std::string(30, '\0')), "give the .tdms file itself"));
  EXPECT_TRUE(contains(fault(std::string("\x01\x02\x00\x04", 4)), "none of the known formats"));
  EXPECT_TRUE(contains(fault(std::string("\xff\xfe"
                                         "1\0\n\0",
                                         6)),
                       "is UTF-16 text"));
  EXPECT_TRUE(contains(error_text([] { read_trace_file("/nowhere/a.csv"); }),
                       "/nowhere/a.csv: cannot be read: No such file"));
  EXPECT_TRUE(contains(error_text([] { read_trace_file("/tmp"); }), "it is a folder"));
  EXPECT_TRUE(contains(error_text([] { read_trace_file("/dev/zero"); }), "it is not a file"));
}

TEST(TraceFile, RefusesSelectionsThatItsFormatDoesNotHave) {
  EXPECT_TRUE(contains(fault("Fx\n1\n2\n", {.point = 1}), "only results in HDF5 have points"));
  EXPECT_TRUE(
      contains(fault("Fx\n1\n2\n", {.segment = 1}), "only LabVIEW .lvm files have segments"));
}

TEST(TraceFile, ListsWhatAFileOffers) {
  const TestFile file("time,Fx\ns,N\n0,1\n1,2\n");
  EXPECT_EQ(trace_variables(file.path()), (std::vector<std::string>{"time", "Fx"}));
}

TEST(NumberOf, IsTheWholeFieldOrNone) {
  EXPECT_EQ(number_of("-1.5e3", '.'), -1500.0);
  EXPECT_EQ(number_of("-1,5e3", ','), -1500.0);
  EXPECT_EQ(number_of("+2", '.'), 2.0);
  EXPECT_EQ(number_of("1e-400", '.'), 0.0);
  for (const char* text : {"", "+", "+-1", "1 2", "1.5.2", "0x10", "1e400", "N", "1,5"}) {
    EXPECT_FALSE(number_of(text, '.')) << text;
  }
  EXPECT_FALSE(number_of("1.5", ','));
  EXPECT_FALSE(number_of(std::string(200, '1'), ','));
}

TEST(SplitNumbers, FindsTheOnlyWay) {
  const auto joined = [](const std::string& row, std::size_t count) {
    return join_split_numbers(split(row, ','), count, {});
  };
  EXPECT_EQ(joined("0,000000,0,013079,-0,000435965,2,5", 4)->values,
            (std::vector<double>{0.0, 0.013079, -0.000435965, 2.5}));
  EXPECT_EQ(joined("8,0005,156,921,-124,-603,81", 4)->values,
            (std::vector<double>{8.0005, 156.921, -124.0, -603.81}));
  EXPECT_EQ(joined("8,1,5e-05,-3", 3)->values, (std::vector<double>{8.0, 1.5e-05, -3.0}));
  EXPECT_EQ(joined("1,2,3", 3)->values, (std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(joined("1,2,3", 2));  // 1.2 and 3, or 1 and 2.3
  EXPECT_FALSE(joined("1,-2,3", 1));
  EXPECT_FALSE(joined("1,x", 1));
}

TEST(SplitNumbers, TakesTheWayCloseToWhatIsExpectedAndSaysSo) {
  const std::vector<double> near = {1.19, 3.05};
  const auto row = join_split_numbers(split("1,2,3", ','), 2, {near, {}});
  ASSERT_TRUE(row);
  EXPECT_TRUE(row->guessed);
  EXPECT_EQ(row->values, (std::vector<double>{1.2, 3.0}));
  // A clock that steps by 0.01 tells better than a force that jumps by tens.
  const auto jump = join_split_numbers(split("3,316,498", ','), 2, {{2.99, 380.0}, {0.01, 30.0}});
  ASSERT_TRUE(jump);
  EXPECT_EQ(jump->values, (std::vector<double>{3.0, 316.498}));
  const std::vector<double> between = {1.1, 2.6};
  EXPECT_FALSE(join_split_numbers(split("1,2,3", ','), 2, {between, {}}));
}

}  // namespace
}  // namespace millstudy::io
