// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millstudy::io {

/// How numbers stand on a line of text.
struct TextDialect {
  char separator = ',';  ///< ' ' for any run of blanks
  char decimal = '.';
  /// Decimals are written with a comma between fields that a comma separates: "0,000000,0,013079".
  bool split_numbers = false;
};

/// Lines of a text one after another, without the bytes that end them; numbers from 1.
class LineReader {
 public:
  explicit LineReader(std::string_view text, int line = 0) : rest_(text), line_(line) {}
  /// false at the end of the text.
  bool next();
  std::string_view text() const { return text_; }
  int number() const { return line_; }
  /// What comes after the current line.
  std::string_view rest() const { return rest_; }
  /// The current line ends with the text and not by an end of line.
  bool unfinished() const { return unfinished_; }

 private:
  std::string_view rest_;
  std::string_view text_;
  int line_;
  bool unfinished_ = false;
};

/// Without the blanks, and one pair of double quotes, around it.
std::string_view trimmed(std::string_view text);

/// Fields of a line, trimmed. An empty last field is none: exports end their lines with separators.
std::vector<std::string_view> split(std::string_view line, char separator);

/// The number that a field is, wholly; nullopt if it is none. NaN and infinity are numbers.
std::optional<double> number_of(std::string_view field, char decimal);

/// A blank line, or one that begins with #, % or //.
bool is_comment(std::string_view line);

/// A line of nothing but blanks and separators: spreadsheets leave such below a table.
bool is_blank_row(std::string_view line, char separator);

/// Whether a line is nothing but numbers, of which some may be missing.
bool is_numbers(std::string_view line, const TextDialect& dialect);

/// The dialect in which a line is nothing but numbers, if there is one.
std::optional<TextDialect> dialect_of(std::string_view line);

}  // namespace millstudy::io
