// SPDX-License-Identifier: MIT
#include "io/traces/text_table.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/core.h>

#include "core/error.h"
#include "io/traces/split_numbers.h"
#include "io/traces/text_rows.h"

namespace millstudy::io {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr int kMostHeaderLines = 5000;
constexpr int kRowsLookedAt = 2000;

/// A line of the header that may be a heading, without the sign that makes it a comment.
std::string_view without_comment_sign(std::string_view line) {
  const auto begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  line.remove_prefix(begin);
  while (!line.empty() && (line.front() == '#' || line.front() == '%')) line.remove_prefix(1);
  if (line.starts_with("//")) line.remove_prefix(2);
  return line;
}

/// Headings of a line; blanks between a name and its unit belong to it.
std::vector<std::string> split_headings(std::string_view line, char separator) {
  std::vector<std::string> headings;
  for (const std::string_view field : split(line, separator)) {
    const auto is_unit = [](std::string_view text) {
      return !text.empty() && (text.front() == '[' || text.front() == '(');
    };
    if (separator == ' ' && is_unit(field) && !headings.empty() && !is_unit(headings.back())) {
      headings.back() += ' ' + std::string(field);
    } else {
      headings.emplace_back(field);
    }
  }
  return headings;
}

bool looks_like_unit(std::string_view field) {
  const TextColumn column = parse_heading(field);
  if (column.name.empty()) return true;
  static constexpr std::string_view kUnits[] = {
      "s",   "sec", "ms", "us",   "min", "N",   "kN", "mN", "V",   "mV",  "Nm", "-",
      "lbf", "daN", "g",  "m/s2", "N.m", "Ncm", "pC", "A",  "deg", "rpm", "um", "mm"};
  return std::find(std::begin(kUnits), std::end(kUnits), field) != std::end(kUnits);
}

/// Headings from the lines right above the numbers, or none.
std::vector<TextColumn> find_headings(const std::vector<std::string_view>& above, char separator,
                                      std::size_t fields) {
  std::vector<TextColumn> columns;
  if (above.empty()) return columns;
  // Names may be separated otherwise than numbers: "# time Fx Fy" above numbers with commas.
  for (const char by : {separator, '\t', ';', ',', ' '}) {
    const std::string_view last_line = without_comment_sign(above.back());
    const std::vector<std::string> last = split_headings(last_line, by);
    const bool possible =
        last.size() == fields || (separator == ',' && by == ',' && last.size() < fields &&
                                  2 * last.size() >= fields && last.size() > 1);
    if (!possible) continue;
    const bool units = std::all_of(last.begin(), last.end(), looks_like_unit);
    if (units && above.size() >= 2) {
      const std::vector<std::string> names =
          split_headings(without_comment_sign(above[above.size() - 2]), by);
      if (names.size() == last.size()) {
        for (std::size_t i = 0; i < names.size(); ++i) {
          const TextColumn unit = parse_heading(last[i]);
          columns.push_back(
              {parse_heading(names[i]).name, unit.name.empty() ? unit.unit : last[i]});
        }
        return columns;
      }
    }
    for (const std::string& text : last) columns.push_back(parse_heading(text));
    return columns;
  }
  return columns;
}

bool same_layout(std::string_view line, const TextDialect& dialect, std::size_t fields) {
  const TextDialect other = {dialect.separator, ','};  // the first row may have no decimals
  const bool possible =
      is_numbers(line, dialect) || (dialect.separator != ',' && is_numbers(line, other));
  if (!possible) return false;
  const std::size_t count = split(line, dialect.separator).size();
  // Numbers in two parts take fewer fields where they are whole.
  return count == fields ||
         (dialect.separator == ',' && 2 * count >= fields && 2 * fields >= count);
}

/// Decimal commas that the first row does not show, and numbers in two parts.
void refine(TextTable& table, std::size_t fields, std::size_t names) {
  TextDialect& dialect = table.dialect;
  LineReader reader(table.rows);
  std::size_t most = fields;
  std::size_t rows = 0;
  std::size_t longer = 0;
  bool commas = false;
  bool points = false;
  bool parts = true;
  for (int i = 0; i < kRowsLookedAt && reader.next(); ++i) {
    if (is_comment(reader.text())) continue;
    const std::vector<std::string_view> row = split(reader.text(), dialect.separator);
    most = std::max(most, row.size());
    ++rows;
    longer += row.size() > names ? 1 : 0;
    for (const std::string_view field : row) {
      commas |= field.find(',') != std::string_view::npos;
      points |= field.find('.') != std::string_view::npos;
      parts &= is_number_part(field);
    }
  }
  if (dialect.separator == ',') {
    dialect.split_numbers = parts && names > 0 && most <= 2 * names && 2 * longer > rows;
  } else if (commas && !points) {
    dialect.decimal = ',';
  }
}

std::string column_list(const std::vector<TextColumn>& columns) {
  std::string text;
  for (std::size_t i = 0; i < columns.size() && text.size() < 200; ++i) {
    text += (i == 0 ? "" : ", ") + columns[i].name;
  }
  return text;
}

std::string lower(std::string_view text) {
  std::string copy(text);
  std::transform(copy.begin(), copy.end(), copy.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return copy;
}

bool is_time(const TextColumn& column) {
  static constexpr std::string_view kNames[] = {"time", "t", "zeit", "x_value", "temps", "tempo"};
  const std::string name = lower(column.name);
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames) ||
         (!column.unit.empty() && seconds_per_unit(column.unit));
}

}  // namespace

TextColumn parse_heading(std::string_view text) {
  text = trimmed(text);
  for (const std::string_view brackets : {"[]", "()"}) {
    const std::size_t open = text.rfind(brackets[0]);
    if (open == std::string_view::npos || text.back() != brackets[1]) continue;
    const std::string_view unit = text.substr(open + 1, text.size() - open - 2);
    return {std::string(trimmed(text.substr(0, open))), std::string(trimmed(unit))};
  }
  return {std::string(text), ""};
}

std::optional<double> seconds_per_unit(std::string_view unit) {
  struct Unit {
    std::string_view name;
    double seconds;
  };
  static constexpr Unit kUnits[] = {{"s", 1.0},          {"sec", 1.0},   {"second", 1.0},
                                    {"seconds", 1.0},    {"ms", 1e-3},   {"us", 1e-6},
                                    {"min", 60.0},       {"h", 3600.0},  {"\xc2\xb5s", 1e-6},
                                    {"\xce\xbcs", 1e-6}, {"\xb5s", 1e-6}};
  for (const Unit& known : kUnits) {
    if (known.name == unit) return known.seconds;
  }
  return {};
}

TextTable find_table(const Source& source) {
  std::string_view text = source.bytes;
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw core::InputError({source.path, 0}, "is UTF-16 text: save it as UTF-8 or plain text");
  }
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  LineReader reader(text);
  std::vector<std::string_view> above;
  TextTable table;
  while (reader.number() < kMostHeaderLines) {
    const std::string_view before = reader.rest();
    if (!reader.next()) break;
    const std::optional<TextDialect> dialect = dialect_of(reader.text());
    if (dialect) {
      const std::size_t fields = split(reader.text(), dialect->separator).size();
      LineReader next(reader.rest());
      while (next.next() && is_comment(next.text())) {
      }
      if (next.text().empty() || same_layout(next.text(), *dialect, fields)) {
        table.dialect = *dialect;
        table.header = text.substr(0, text.size() - before.size());
        table.rows = before;
        table.line_before = reader.number() - 1;
        table.columns = find_headings(above, dialect->separator, fields);
        refine(table, fields, table.columns.size());
        if (!table.dialect.split_numbers && table.columns.size() != fields) {
          table.columns.assign(fields, {});
        }
        for (std::size_t i = 0; i < table.columns.size(); ++i) {
          if (table.columns[i].name.empty()) table.columns[i].name = std::to_string(i + 1);
        }
        return table;
      }
    }
    if (!trimmed(reader.text()).empty()) above.push_back(reader.text());
    if (above.size() > 2) above.erase(above.begin());
  }
  throw core::InputError({source.path, 0},
                         fmt::format("has no rows of numbers in its first {} lines; a column of "
                                     "clock times or words must be left out",
                                     std::min(reader.number(), kMostHeaderLines)));
}

std::size_t find_column(const Source& source, const std::vector<TextColumn>& columns,
                        const std::string& wanted) {
  std::vector<std::size_t> exact;
  std::vector<std::size_t> similar;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == wanted) exact.push_back(i);
    if (lower(columns[i].name) == lower(wanted)) similar.push_back(i);
  }
  const std::vector<std::size_t>& found = exact.empty() ? similar : exact;
  if (found.size() == 1) return found.front();
  if (found.size() > 1) {
    throw core::InputError({source.path, 0},
                           fmt::format("columns {} and {} are both called {}: give a number",
                                       found[0] + 1, found[1] + 1, wanted));
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  const bool whole = error == std::errc() && end == wanted.data() + wanted.size();
  if (whole && number >= 1 && number <= columns.size()) return number - 1;
  throw core::InputError({source.path, 0}, fmt::format("has no column {}; it has {}: {}", wanted,
                                                       columns.size(), column_list(columns)));
}

ColumnChoice choose_columns(const Source& source, const std::vector<TextColumn>& columns,
                            const TraceSelection& selection) {
  ColumnChoice choice;
  for (const auto& [name, wanted] : selection.variables) {
    const std::size_t column = find_column(source, columns, wanted);
    if (name == "time") {
      choice.time = column;
    } else {
      choice.names.push_back(name);
      choice.columns.push_back(column);
    }
  }
  for (std::size_t i = 0; i < columns.size() && !choice.time; ++i) {
    const bool taken =
        std::find(choice.columns.begin(), choice.columns.end(), i) != choice.columns.end();
    if (is_time(columns[i]) && !taken) choice.time = i;
  }
  if (choice.columns.empty()) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (choice.time == i) continue;
      choice.names.push_back(columns[i].name);
      choice.columns.push_back(i);
    }
  }
  return choice;
}

identify::ChannelSet read_table(const Source& source, const TextTable& table,
                                const TraceSelection& selection) {
  const ColumnChoice choice = choose_columns(source, table.columns, selection);
  RowLayout layout;
  layout.dialect = table.dialect;
  layout.fields = table.columns.size();
  layout.columns = choice.columns;
  if (choice.time) layout.columns.push_back(*choice.time);
  std::sort(layout.columns.begin(), layout.columns.end());
  layout.columns.erase(std::unique(layout.columns.begin(), layout.columns.end()),
                       layout.columns.end());
  for (const std::size_t column : layout.columns)
    layout.names.push_back(table.columns[column].name);
  TraceFaults faults(source.path);
  LineReader reader(table.rows, table.line_before);
  Rows rows = read_rows(source.path, reader, layout, selection.range, faults);
  faults.throw_if_any();
  const auto values = [&](std::size_t column) -> std::vector<double>& {
    const auto at = std::lower_bound(layout.columns.begin(), layout.columns.end(), column);
    return rows.values[static_cast<std::size_t>(at - layout.columns.begin())];
  };
  identify::ChannelSet set;
  set.source = source.path;
  for (std::size_t i = 0; i < choice.columns.size(); ++i) {
    set.channels.push_back({choice.names[i], table.columns[choice.columns[i]].unit, {}});
  }
  if (choice.time) {
    set.time = values(*choice.time);
    const double seconds = seconds_per_unit(table.columns[*choice.time].unit).value_or(1.0);
    for (double& time : set.time) time *= seconds;
  }
  for (std::size_t i = 0; i < choice.columns.size(); ++i) {
    const bool again = std::find(choice.columns.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 choice.columns.end(), choice.columns[i]) != choice.columns.end();
    std::vector<double>& from = values(choice.columns[i]);
    set.channels[i].samples = again ? from : std::move(from);
  }
  set.lines = std::move(rows.lines);
  set.remarks = std::move(rows.remarks);
  return set;
}

}  // namespace millstudy::io
