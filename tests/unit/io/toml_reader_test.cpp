// SPDX-License-Identifier: MIT
#include "io/toml_reader.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"

namespace millstudy::io {
namespace {

using core::Value;

/// The one line that reading this text is refused with.
std::string refusal(const std::string& text) {
  try {
    parse_toml(text, "s.toml");
  } catch (const core::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "accepted";
}

std::string file_refusal(const std::string& path) {
  try {
    read_toml(path);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<std::string> keys(const Value& table) {
  std::vector<std::string> names;
  for (const core::Member& member : table.table()) names.push_back(member.key);
  return names;
}

std::string repeat(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

TEST(Toml, KeepsTheOrderAndTheLinesOfTheFile) {
  const Value root = parse_toml(
      "zeta = 1\n"
      "[sweep.axes]\n"
      "\"path.method\" = [\"newton\",\n"
      "  \"taylor1\"]\n"
      "b.y = 1.5\n"
      "a = { from = 1, to = 2, count = 3 }\n"
      "b.x = true\n"
      "[[modes.x]]\n"
      "m = 1\n"
      "[[modes.x]]\n"
      "k = 2\n"
      "[alpha]\n",
      "s.toml");
  EXPECT_EQ(keys(root), (std::vector<std::string>{"zeta", "sweep", "modes", "alpha"}));
  const Value& axes = *root.find("sweep")->find("axes");
  EXPECT_EQ(keys(axes), (std::vector<std::string>{"path.method", "b", "a"}));
  EXPECT_EQ(keys(*axes.find("b")), (std::vector<std::string>{"y", "x"}));
  EXPECT_EQ(keys(*axes.find("a")), (std::vector<std::string>{"from", "to", "count"}));
  EXPECT_EQ(axes.find("path.method")->array()[1].place.line, 4);
  EXPECT_EQ(axes.find("path.method")->place.line, 3);
  EXPECT_EQ(axes.find("b")->find("x")->place.line, 7);
  EXPECT_EQ(root.find("modes")->find("x")->array()[1].find("k")->place.line, 11);
  EXPECT_EQ(root.find("modes")->find("x")->array()[1].place.line, 10);
  EXPECT_EQ(root.find("alpha")->place.line, 12);
  EXPECT_EQ(root.find("sweep")->place.line, 2);
  EXPECT_EQ(root.find("zeta")->place.file, "s.toml");
}

TEST(Toml, ReadsEveryTypeOfValue) {
  const Value root = parse_toml(
      "i = -3\nx = 1e3\nb = true\ns = \"größe\"\nn = nan\nm = -inf\nbig = 9223372036854775807\n",
      "s");
  EXPECT_EQ(std::get<std::int64_t>(root.find("i")->data), -3);
  EXPECT_EQ(std::get<double>(root.find("x")->data), 1000.0);
  EXPECT_TRUE(std::get<bool>(root.find("b")->data));
  EXPECT_EQ(root.find("s")->string(), "größe");
  EXPECT_TRUE(std::isnan(root.find("n")->number()));
  EXPECT_EQ(root.find("m")->number(), -INFINITY);
  EXPECT_EQ(std::get<std::int64_t>(root.find("big")->data), INT64_MAX);
}

TEST(Toml, RefusesBrokenTextInOneLineWithItsPlace) {
  using std::string_literals::operator""s;
  for (const auto& [text, start] : std::vector<std::pair<std::string, std::string>>{
           {"a = 1\nb = \n", "s.toml:2: "},
           {"a = 1\na = 2\n", "s.toml:2: "},
           {"[a]\n[a]\n", "s.toml:2: "},
           {"a = 1\n[a.b]\n", "s.toml:2: "},
           {"a = 99999999999999999999\n", "s.toml:1: "},
           {"\na = \"open\n", "s.toml:2: "},
           {"a = \"\"\"open\n", "s.toml:"},
           {"a = [1, 2\n", "s.toml:"},
           {"a = 1979-05-27\n", "s.toml:1: dates and times"},
           {"a = 1\nb = [07:32:00]\n", "s.toml:2: dates and times"},
           {"a = 1979-05-27T07:32:00Z\n", "s.toml:1: dates and times"},
           {"a = \"\xff\xfe\"\n", "s.toml:1: "},
           {"a = 1\n\xff\n", "s.toml:2: "},
           {"a = \"x\0y\"\n"s, "s.toml:1: "},
           {"\0\0\0\0"s, "s.toml:"},
           {"= 1\n", "s.toml:1: "},
           {"a b = 1\n", "s.toml:1: "},
           {"[a\n", "s.toml:"},
           {"a = 1 b = 2\n", "s.toml:1: "},
           {"a = 0x\n", "s.toml:1: "},
           {"a = +-1\n", "s.toml:1: "},
           {"a = \"\\q\"\n", "s.toml:1: "},
           {"a = {b = 1\n}\n", "s.toml:"}}) {
    EXPECT_EQ(refusal(text).substr(0, start.size()), start) << text << "\n" << refusal(text);
  }
}

TEST(Toml, ReportsEveryDate) {
  try {
    parse_toml("a = 1979-05-27\nb = 07:32:00\n", "s.toml");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.faults().size(), 2u);
  }
}

TEST(Toml, RefusesDeepNestingWithoutOverflow) {
  EXPECT_EQ(refusal("a = " + repeat("[", 100000)).substr(0, 9), "s.toml:1:");
  EXPECT_EQ(refusal("a = " + repeat("[", 100000) + repeat("]", 100000)).substr(0, 9), "s.toml:1:");
  EXPECT_EQ(refusal("\na = " + repeat("{a = ", 100000)).substr(0, 9), "s.toml:2:");
  EXPECT_EQ(refusal("\na" + repeat(".a", 100000) + " = 1").substr(0, 9), "s.toml:2:");
  EXPECT_EQ(refusal("\na" + repeat(" . \"b.c\"", 100000) + " = 1").substr(0, 9), "s.toml:2:");
  EXPECT_EQ(refusal("[a" + repeat(".a", 100000) + "]").substr(0, 9), "s.toml:1:");
  EXPECT_EQ(refusal("a = " + repeat("{a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = ", 60)).substr(0, 9),
            "s.toml:1:");
}

TEST(Toml, TakesDotsThatAreNotOfKeys) {
  EXPECT_EQ(refusal("a = [" + repeat("1.0, ", 1000) + "]"), "accepted");
  EXPECT_EQ(refusal("a = \"" + repeat(".", 1000) + "\""), "accepted");
  EXPECT_EQ(refusal("a = '''" + repeat("...\n'", 1000) + "'''"), "accepted");
  EXPECT_EQ(refusal("a = \"\"\"\\\"\"\" " + repeat(".", 100) + "\"\"\""), "accepted");
  EXPECT_EQ(refusal("a = 1 # " + repeat(".", 1000) + " it's"), "accepted");
  EXPECT_EQ(refusal("a = [\n" + repeat("1.0,\n", 1000) + "]"), "accepted");
}

TEST(Toml, RefusesCharactersBeyondAsciiOutsideTextsAndComments) {
  for (const std::string text : {"[öl]\n", "[a.ö]\n", "öl = 1\n", "a = ö\n", "a = [1,\u00a02]\n",
                                 "a = 1 ö\n", "a = {ö = 1}\n", "[\u3000]\n", "[[ж]]\n",
                                 "a = \"open\\\n[ö]\n", "a = 'open\n[ö]\n", "a = 1\ufeff\n"}) {
    EXPECT_EQ(refusal("\n" + text).substr(0, 7), "s.toml:") << text;
  }
  // The parser takes these quotes for a part of what is before them.
  for (const std::string text :
       {"a = -'\ufef7'\n", "a = 1\"\u2003\"\n", "a = 1979-05-27 '\ufef7'\n", "a = it's ö'\n",
        "a = [1.0, 1.'\u03e2']\n", "a = 1['\ufef7'\n", "a = 1={'ﻷ'\n", "a = {b = 1.'\ufef7'}\n",
        "a = [[1], 2['\ufef7']]\n", "a = ['b'['\ufef7']]\n", "a = [\n1.'\ufef7']\n"}) {
    EXPECT_EQ(refusal(text).substr(0, 7), "s.toml:") << text;
  }
  EXPECT_EQ(refusal("\n\n[öl]\n"),
            "s.toml:3: ö cannot stand there: names of keys are letters a to z, digits, _ and -; "
            "texts go in \"quotes\"");
  EXPECT_EQ(refusal("a = 'ö' # ö\n# ö\n\"ö\" = \'\'\'\nö\'\'\'\nb = \"\"\"ö\"\"\"\n"), "accepted");
  EXPECT_EQ(refusal("'ö'.\t'é' = ['ö' ,'é', # ö\n'ö']\r\nb = {'ö' = \"ö\", 'é'='ö'}\n'é' = 1\n"
                    "c = [\n'ö',\n[ \"ö\", {'ö' = 'ö', b.'ö' = ['ö']}, 'ö' ], 'ö'\n, 'ö'\n]\n"
                    "d = ''\ne = \"\"\nf.'ö'.g = 1.5\nh = 'ö'\n"
                    "['ü']\n[ 'ß' . 'ü']\n[[ 'ä' ]]\n"),
            "accepted");
}

TEST(Toml, SurvivesCharactersBeyondAsciiAfterABackslash) {
  // Of every range that the parser has for spaces beyond ASCII, one that is a space and others.
  for (const std::string c : {"\u00a0", "é", "ж", "\u1680", "\u1700", "\u2003", "\u2100", "\u3000",
                              "語", "\ufef7", "\ufeff", "𝛼"}) {
    EXPECT_EQ(refusal("a = \"\"\"b \\\n  " + c + "\"\"\"\n"), "accepted") << c;
    for (const std::string& text :
         {"a = \"\"\"\\" + c + "\"\"\"\n", "a = \"\"\"\\ " + c + "\"\"\"\n",
          "a = \"\\" + c + "\"\n", "a = \"\"\"\\" + c}) {
      EXPECT_EQ(refusal(text).substr(0, 7), "s.toml:") << text;
    }
  }
}

TEST(Toml, RefusesWhatIsNoReadableFile) {
  const std::string folder = testing::TempDir() + "/toml_reader";
  std::filesystem::create_directories(folder);
  EXPECT_NE(file_refusal(folder + "/none.toml").find("No such file"), std::string::npos);
  EXPECT_NE(file_refusal(folder).find("is a folder"), std::string::npos);
  EXPECT_NE(file_refusal("/dev/zero").find("is not a regular file"), std::string::npos);
  EXPECT_NE(file_refusal("").find("No such file"), std::string::npos);
  const std::string fifo = folder + "/fifo.toml";
  ::unlink(fifo.c_str());
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_NE(file_refusal(fifo).find("is not a regular file"), std::string::npos);
  const std::string large = folder + "/large.toml";
  std::ofstream(large) << "a = 1\n";
  std::filesystem::resize_file(large, (8u << 20) + 1);
  EXPECT_NE(file_refusal(large).find("larger than 8 MiB"), std::string::npos);
  if (::geteuid() != 0) {
    std::filesystem::permissions(large, std::filesystem::perms::none);
    EXPECT_NE(file_refusal(large).find("Permission denied"), std::string::npos);
  }
  std::filesystem::remove_all(folder);
}

TEST(Toml, ReadsFilesWithMarksAndForeignLineEnds) {
  const std::string path = testing::TempDir() + "/toml_marks.toml";
  std::ofstream(path, std::ios::binary) << "\xef\xbb\xbf"
                                           "a = 1\r\nb = 2\r\n";
  EXPECT_EQ(read_toml(path).find("b")->place.line, 2);
  std::ofstream(path, std::ios::trunc) << "";
  EXPECT_TRUE(read_toml(path).table().empty());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace millstudy::io
