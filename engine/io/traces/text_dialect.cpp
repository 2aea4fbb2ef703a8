// SPDX-License-Identifier: MIT
#include "io/traces/text_dialect.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

namespace millstudy::io {
namespace {

constexpr std::size_t kLongestNumber = 64;

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split_at_blanks(std::string_view line) {
  std::vector<std::string_view> fields;
  for (line = without_blanks(line); !line.empty(); line = without_blanks(line)) {
    // A quoted name may hold blanks.
    const std::size_t quote = line.front() == '"' ? line.find('"', 1) : std::string_view::npos;
    const std::size_t end = quote != std::string_view::npos
                                ? quote + 1
                                : std::min(line.find_first_of(" \t"), line.size());
    fields.push_back(trimmed(line.substr(0, end)));
    line.remove_prefix(end);
  }
  return fields;
}

}  // namespace

bool LineReader::next() {
  if (rest_.empty()) return false;
  const void* const found = std::memchr(rest_.data(), '\n', rest_.size());
  unfinished_ = found == nullptr;
  const std::size_t length =
      unfinished_ ? rest_.size()
                  : static_cast<std::size_t>(static_cast<const char*>(found) - rest_.data());
  text_ = rest_.substr(0, length);
  rest_.remove_prefix(unfinished_ ? length : length + 1);
  while (!text_.empty() && text_.back() == '\r') text_.remove_suffix(1);
  ++line_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  text = without_blanks(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = without_blanks(text.substr(1, text.size() - 2));
  }
  return text;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  if (separator == ' ') return split_at_blanks(line);
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] != separator || quoted) continue;
    fields.push_back(trimmed(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  const std::string_view last = trimmed(line.substr(begin));
  if (!last.empty()) fields.push_back(last);
  return fields;
}

std::optional<double> number_of(std::string_view field, char decimal) {
  std::array<char, kLongestNumber> copy;
  if (decimal != '.') {
    if (field.size() > copy.size() || field.find('.') != std::string_view::npos) return {};
    std::replace_copy(field.begin(), field.end(), copy.begin(), decimal, '.');
    field = {copy.data(), field.size()};
  }
  if (!field.empty() && field.front() == '+') {
    field.remove_prefix(1);
    if (!field.empty() && field.front() == '-') return {};
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size()) return {};
  if (error == std::errc::result_out_of_range) {  // too small is zero, too large no number
    const std::size_t e = field.find_first_of("eE");
    return e + 1 < field.size() && field[e + 1] == '-' ? std::optional(0.0) : std::nullopt;
  }
  if (error != std::errc()) return {};
  return value;
}

bool is_comment(std::string_view line) {
  line = without_blanks(line);
  return line.empty() || line.front() == '#' || line.front() == '%' || line.starts_with("//");
}

bool is_blank_row(std::string_view line, char separator) {
  return std::all_of(line.begin(), line.end(),
                     [&](char c) { return is_blank(c) || c == separator || c == '\r'; });
}

bool is_numbers(std::string_view line, const TextDialect& dialect) {
  const std::vector<std::string_view> fields = split(line, dialect.separator);
  bool any = false;
  for (const std::string_view field : fields) {
    if (field.empty()) continue;  // a value that is missing
    if (!number_of(field, dialect.decimal)) return false;
    any = true;
  }
  return any;
}

std::optional<TextDialect> dialect_of(std::string_view line) {
  if (is_comment(line)) return {};
  for (const char separator : {'\t', ';'}) {
    if (line.find(separator) == std::string_view::npos) continue;
    for (const char decimal : {'.', ','}) {
      if (is_numbers(line, {separator, decimal})) return TextDialect{separator, decimal};
    }
    // "12; 13" is separated by semicolons; a tab may only be there to align.
    if (separator == ';') return {};
  }
  // "1,5 2,5" has decimal commas, "1, 2" and "1,5" commas between the fields.
  const bool blanks = without_blanks(line).find_first_of(" \t") != std::string_view::npos;
  if (blanks && is_numbers(line, {' ', '.'})) return TextDialect{' ', '.'};
  if (blanks && is_numbers(line, {' ', ','}) && line.find(", ") == std::string_view::npos) {
    return TextDialect{' ', ','};
  }
  if (line.find(',') != std::string_view::npos) {
    if (is_numbers(line, {',', '.'})) return TextDialect{',', '.'};
    return {};
  }
  if (is_numbers(line, {' ', '.'})) return TextDialect{' ', '.'};  // one column
  return {};
}

}  // namespace millstudy::io
