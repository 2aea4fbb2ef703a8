// SPDX-License-Identifier: MIT
#include "io/toml_hint.h"

#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 sees uninitialized memory in its own <regex> under the address sanitizer (bug 105562).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fmt/core.h>
#include <iterator>
#include <mutex>
#include <optional>
#include <regex>

namespace millstudy::io {
namespace {

/// std::regex needs stack for every character: longer lines get no hint.
constexpr std::size_t kLongestLine = 400;

std::string_view line_of(std::string_view text, int line) {
  for (; line > 1 && !text.empty(); --line) {
    const std::size_t end = text.find('\n');
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
  text = text.substr(0, text.find('\n'));
  return text.ends_with('\r') ? text.substr(0, text.size() - 1) : text;
}

/// The line without its comment, with "" for every text, without spaces around.
std::string bare(std::string_view line) {
  std::string result;
  for (std::size_t i = 0; i < line.size() && line[i] != '#'; ++i) {
    if (line[i] == '"' || line[i] == '\'') {
      i = line.find(line[i], i + 1);
      result += "\"\"";
      if (i == line.npos) break;
    } else {
      result += line[i];
    }
  }
  const std::size_t first = result.find_first_not_of(" \t");
  const std::size_t last = result.find_last_not_of(" \t");
  return first == result.npos ? "" : result.substr(first, last - first + 1);
}

using Match = std::smatch;

/// MATLAB's from:step:to or from:to, and linspace(from, to, count).
std::string range_hint(const Match& m) {
  const bool stepped = m[3].matched;
  const double from = std::strtod(m.str(1).c_str(), nullptr);
  const double step = stepped ? std::strtod(m.str(2).c_str(), nullptr) : 1.0;
  const std::string last = stepped ? m.str(3) : m.str(2);
  const double intervals = (std::strtod(last.c_str(), nullptr) - from) / step;
  const double whole = std::round(intervals);
  const bool fits = std::abs(intervals - whole) < 1e-6 && whole >= 1.0 && whole < 1e6;
  return fits ? fmt::format("a range is written {{ from = {}, to = {}, count = {:.0f} }}", m.str(1),
                            last, whole + 1.0)
              : std::string("a range is written { from = 0, to = 50, count = 26 }");
}

std::string linspace_hint(const Match& m) {
  return fmt::format("a range is written {{ from = {}, to = {}, count = {} }}", m.str(1), m.str(2),
                     m.str(3));
}

std::string decimal_comma(const Match& m) {
  return fmt::format("decimals take a point: {}.{}", m.str(1), m.str(2));
}

std::string no_leading_digit(const Match& m) {
  return fmt::format("a digit must stand on both sides of the point: {}0.{}", m.str(1), m.str(2));
}

std::string no_digit_after(const Match& m) {
  return fmt::format("a digit must stand on both sides of the point: {}.0", m.str(1));
}

std::string flag(const Match& m) {
  const char c = static_cast<char>(std::tolower(static_cast<unsigned char>(m.str(1)[0])));
  const bool yes = c == 't' || c == 'y' || m.str(1) == "on" || m.str(1) == "On";
  return fmt::format("{} is written {}", m.str(1), yes ? "true" : "false");
}

std::string unit(const Match& m) {
  return fmt::format("no unit after a number (the key's name says it): {}", m.str(1));
}

std::string missing_comma(const Match& m) {
  return fmt::format("commas between the values of a list: {}, {}", m.str(1), m.str(2));
}

std::string missing_quotes(const Match& m) {
  return fmt::format("text goes in \"quotes\": \"{}\"", m.str(1));
}

/// A slip: how the line is recognised, and what is said; {} there is nothing.
struct Slip {
  const char* pattern;
  std::string (*say)(const Match&);
};

#define MILLSTUDY_NUMBER "[+-]?[0-9]+(?:\\.[0-9]+)?(?:[eE][+-]?[0-9]+)?"

/// Of the whole line.
const Slip kLineSlips[] = {
    {"^(%|//|;|--|!)",
     [](const Match& m) { return fmt::format("comments start with #, not {}", m.str(1)); }},
    {"[0-9a-z\"\\]}]\\s*(%|//|;)\\s*[^0-9\\s\"].*$",
     [](const Match& m) { return fmt::format("comments start with #, not {}", m.str(1)); }},
    {"[0-9a-z\"\\]}]\\s*;$", [](const Match&) { return std::string("no ; at the end of a line"); }},
    {"^[A-Za-z0-9_.\"-]+\\s*(:=|:|==)\\s*[^\\s:]",
     [](const Match& m) { return fmt::format("a value follows =, not {}", m.str(1)); }},
    {"=$", [](const Match&) { return std::string("a value is missing after ="); }},
};

/// Of what follows the first =, or of the whole line if it has none; the first that fits counts.
const Slip kValueSlips[] = {
    {"(" MILLSTUDY_NUMBER ")\\s*:\\s*(" MILLSTUDY_NUMBER ")(?:\\s*:\\s*(" MILLSTUDY_NUMBER "))?",
     range_hint},
    {"linspace\\s*\\(\\s*(" MILLSTUDY_NUMBER ")\\s*,\\s*(" MILLSTUDY_NUMBER
     ")\\s*,\\s*([0-9]+)\\s*\\)",
     linspace_hint},
    {"(?:^|=)\\s*[+-]?[0-9]+(?:,[0-9]+)*(?:,[0-9]+\\.|\\.[0-9]+,)[0-9]",
     [](const Match&) {
       return std::string("decimals take a point, and thousands nothing: 12000.5");
     }},
    {"(?:^|=)\\s*([+-]?[0-9]+),([0-9]+)", decimal_comma},
    {"(?:^|[\\s\\[,=])([+-]?)\\.([0-9]+)", no_leading_digit},
    {"(?:^|[\\s\\[,=])([+-]?[0-9]+)\\.(?=$|[\\s,\\]};eE])", no_digit_after},
    {"(?:^|[\\[,=])\\s*(True|TRUE|False|FALSE|yes|Yes|YES|no|No|NO|on|On|off|Off)\\s*(?=$|[,\\]}])",
     flag},
    {"[{,]\\s*[A-Za-z_]+\\s*:",
     [](const Match&) { return std::string("a value follows =, not :"); }},
    {"(?:^|[\\[,=])\\s*(null|NULL|None|nil)\\s*(?=$|[,\\]}])",
     [](const Match& m) { return fmt::format("there is no {}: leave the key out", m.str(1)); }},
    {"[A-Za-z_]\\(",
     [](const Match&) {
       return std::string("no functions; a range is written { from = 0, to = 50, count = 26 }");
     }},
    {"[0-9)]\\s*[*/^]\\s*[0-9(a-z]|\\bpi\\b",
     [](const Match&) { return std::string("no arithmetic in a value: write the number itself"); }},
    {"\\{[^{}]*[^,{\\s]\\s+[A-Za-z0-9_.-]+\\s*=",
     [](const Match&) { return std::string("commas between the keys of a { }"); }},
    {"(?:^|[\\s\\[,=])(" MILLSTUDY_NUMBER ")\\s+[A-Za-z0-9_.-]+\\s*=",
     [](const Match&) { return std::string("each key takes a line of its own"); }},
    {"(?:^|[\\s\\[,=])(" MILLSTUDY_NUMBER
     ")\\s*(?:%|(?![eE](?:[0-9+-]|$)|(?:inf|nan|true|false|[xob][0-9a-fA-F])\\b)"
     "[A-Za-z][A-Za-z0-9/^*-]*)",
     unit},
    {"\\[.*;", [](const Match&) { return std::string("commas between the values of a list"); }},
    {"\\[(?:[^\\[\\]]*[,\\s])?(" MILLSTUDY_NUMBER ")\\s+(" MILLSTUDY_NUMBER ")", missing_comma},
    {"^(" MILLSTUDY_NUMBER ")\\s+" MILLSTUDY_NUMBER,
     [](const Match&) { return std::string("no space inside a number; a list takes [ ]"); }},
    {"(?:^|[\\[,=])\\s*(?!(?:true|false|inf|nan)\\s*(?:$|[,\\]}]))"
     "([A-Za-z_./~][^,\\[\\]{}=\"]*?)\\s*(?=$|[,\\]}])",
     missing_quotes},
};

#undef MILLSTUDY_NUMBER

/// What the first slip that is in the text says; patterns are compiled when they are first needed.
template <const auto& slips>
std::string first_of(const std::string& text) {
  static std::array<std::optional<std::regex>, std::size(slips)> compiled;
  static std::mutex one_at_a_time;
  const std::lock_guard guard(one_at_a_time);
  for (std::size_t i = 0; i < std::size(slips); ++i) {
    if (!compiled[i]) compiled[i].emplace(slips[i].pattern);
    Match match;
    if (std::regex_search(text, match, *compiled[i])) return slips[i].say(match);
  }
  return {};
}

/// "Error while parsing X: cannot redefine existing table 'cut'".
std::string twice(std::string_view line, std::string_view description) {
  const std::size_t open = description.find('\'');
  const std::size_t close = description.rfind('\'');
  if (open == description.npos || close <= open) return {};
  const std::string_view name = description.substr(open + 1, close - open - 1);
  return line.starts_with('[') ? fmt::format("[{}] is given twice", name)
                               : fmt::format("{} is given twice", name);
}

}  // namespace

std::string hint(std::string_view toml, int line, std::string_view description) {
  const auto says = [&](std::string_view part) { return description.find(part) != part.npos; };
  const std::string plain(description);
  const std::string_view whole = line_of(toml, line);
  const std::string code = bare(whole.substr(0, kLongestLine));
  if (says("cannot redefine")) {
    const std::string said = twice(code, description);
    return said.empty() ? plain : said;
  }
  if (says("exceeded maximum nested value depth")) return "lists or tables nested too deeply";
  if (whole.size() > kLongestLine) return plain;
  if (says("escape sequence")) {
    return "a \\ in a text starts a special character: write / in paths, or the text in 'single "
           "quotes'";
  }
  if (says("parsing string") && says("control characters")) {
    return whole.find_first_of(std::string_view("\0\x01\x1b\x7f", 4)) == whole.npos
               ? "the closing quote is missing"
               : plain;
  }
  if (says("parsing table header") && says("expected ']'")) return "the closing ] is missing";
  const std::size_t equals = code.find('=');
  const bool has_value = equals != code.npos;
  if (says("expected comma or closing ']'") && has_value && code.find('[', equals) == code.npos) {
    return "the closing ] of the list above is missing";
  }
  std::string said = first_of<kLineSlips>(code);
  if (said.empty()) {
    std::string value = has_value ? code.substr(equals + 1) : code;
    value.erase(0, value.find_first_not_of(" \t"));
    const bool is_value = has_value || says("parsing array") || says("parsing inline table");
    if (is_value) said = first_of<kValueSlips>(value);
  }
  if (!said.empty()) return said;
  // The parser went on to the next key: "expected comma or closing ']', saw 'p'".
  const bool at_start = says("expected comma or closing ']'") && !code.empty() &&
                        says(fmt::format("saw '{}'", code[0]));
  return at_start && has_value ? "the closing ] of the list above is missing" : plain;
}

}  // namespace millstudy::io
