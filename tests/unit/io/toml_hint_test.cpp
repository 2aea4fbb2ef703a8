// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/toml_reader.h"

namespace millstudy::io {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_toml(text, "s");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

using Cases = std::vector<std::pair<std::string, std::string>>;

void expect(const Cases& cases) {
  for (const auto& [line, said] : cases) {
    EXPECT_EQ(refusal("x = 1\n" + line + "\ny = 2\n"), "s:2: " + said) << line;
  }
}

TEST(TomlHint, NamesTheNumberThatIsMeant) {
  const std::string point = "a digit must stand on both sides of the point: ";
  expect({{"a = 0,5", "decimals take a point: 0.5"},
          {"a = -12,25  # deep", "decimals take a point: -12.25"},
          {"a = { from = 0,5, to = 3,0, count = 6 }", "decimals take a point: 0.5"},
          {"a = .5", point + "0.5"},
          {"a = -.5", point + "-0.5"},
          {"a = [1.0, .25]", point + "0.25"},
          {"a = 3.", point + "3.0"},
          {"a = [3., 4.0]", point + "3.0"},
          {"a = 12,000.5", "decimals take a point, and thousands nothing: 12000.5"},
          {"a = 1.000,5", "decimals take a point, and thousands nothing: 12000.5"},
          {"a = 2*3", "no arithmetic in a value: write the number itself"},
          {"a = 1/3", "no arithmetic in a value: write the number itself"},
          {"a = 14 500", "no space inside a number; a list takes [ ]"}});
}

TEST(TomlHint, TellsListsAndRanges) {
  expect({{"a = [0:2:50]", "a range is written { from = 0, to = 50, count = 26 }"},
          {"a = 0:2:50", "a range is written { from = 0, to = 50, count = 26 }"},
          {"a = [1:4]", "a range is written { from = 1, to = 4, count = 4 }"},
          {"a = [0:0.1:1]", "a range is written { from = 0, to = 1, count = 11 }"},
          {"a = [0:3:50]", "a range is written { from = 0, to = 50, count = 26 }"},
          {"a = linspace(0, 50, 26)", "a range is written { from = 0, to = 50, count = 26 }"},
          {"a = range(0, 50, 2)",
           "no functions; a range is written { from = 0, to = 50, count = 26 }"},
          {"a = { from: 0, to: 3 }", "a value follows =, not :"},
          {"a = { from = 0 to = 3 }", "commas between the keys of a { }"},
          {"a = [0.5 3.0]", "commas between the values of a list: 0.5, 3.0"},
          {"a = [0.5, 1.0 3.0]", "commas between the values of a list: 1.0, 3.0"},
          {"a = [0.5; 3.0]", "commas between the values of a list"}});
  expect({{"a = 1e400",
           "Error while parsing floating-point: '1e400' could not be interpreted as a value"}});
  EXPECT_EQ(refusal("a = [[0.5, 3.0]\nb = [2]\n"),
            "s:2: the closing ] of the list above is missing");
  EXPECT_EQ(refusal("a = [0.5, 3.0\nb = 2\n"), "s:2: the closing ] of the list above is missing");
}

TEST(TomlHint, TellsTextsAndFlags) {
  expect({{"a = slot", "text goes in \"quotes\": \"slot\""},
          {"a = force", "text goes in \"quotes\": \"force\""},
          {"a = my first study", "text goes in \"quotes\": \"my first study\""},
          {"a = ../data/ggg70.toml", "text goes in \"quotes\": \"../data/ggg70.toml\""},
          {"a = [\"newton\", taylor1]", "text goes in \"quotes\": \"taylor1\""},
          {"a = “slot”", "“ is no quote of TOML: text goes in straight \"quotes\""},
          {"a = True", "True is written true"},
          {"a = False # not yet", "False is written false"},
          {"a = yes", "yes is written true"},
          {"a = no", "no is written false"},
          {"a = None", "there is no None: leave the key out"},
          {"a = \"slot", "the closing quote is missing"},
          {"a = \"C:\\data\\slot.toml\"",
           "a \\ in a text starts a special character: write / in paths, or the text in 'single "
           "quotes'"}});
}

TEST(TomlHint, TellsUnitsAndComments) {
  const std::string unit = "no unit after a number (the key's name says it): ";
  expect({{"a = 12.0 mm", unit + "12.0"},
          {"a = 12mm", unit + "12"},
          {"a = [1.0 mm, 2.0 mm]", unit + "1.0"},
          {"a = 50 %", unit + "50"},
          {"a = 600 mm/min", unit + "600"},
          {"a = 30°", "°: no unit after a number: the key's name says it"},
          {"a = −1.0", "− is no minus sign: write -"},
          {"a = 12.0;", "no ; at the end of a line"},
          {"a = \"slot\";", "no ; at the end of a line"},
          {"% comment", "comments start with #, not %"},
          {"// comment", "comments start with #, not //"},
          {"a = 12.0 % depth", "comments start with #, not %"},
          {"a = 12.0 // depth", "comments start with #, not //"}});
}

TEST(TomlHint, TellsKeysAndSections) {
  expect({{"x = 3", "x is given twice"},
          {"a: 3", "a value follows =, not :"},
          {"a := 3", "a value follows =, not :="},
          {"a =", "a value is missing after ="},
          {"a = # 3", "a value is missing after ="},
          {"a = 1 b = 2", "each key takes a line of its own"},
          {"[cut", "the closing ] is missing"}});
  EXPECT_EQ(refusal("[cut]\na = 1\n[cut]\n"), "s:3: [cut] is given twice");
}

TEST(TomlHint, LeavesLongLinesToTheParser) {
  EXPECT_EQ(refusal("a = " + std::string(100000, 'x')).substr(0, 24), "s:1: Error while parsing");
}

}  // namespace
}  // namespace millstudy::io
