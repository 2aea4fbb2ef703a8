// SPDX-License-Identifier: MIT
#include "io/traces/text_rows.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <utility>

#include "io/traces/split_numbers.h"

namespace millstudy::io {
namespace {

constexpr int kRowsLookedAt = 1000;
constexpr int kNearRows = 3;
constexpr double kNewest = 0.05;  // weight of the newest change

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// The number at the beginning of [at, end) if it is followed by blanks and the separator or the
/// end; moves `at` there. Decimal points only. NaN marks nothing: `ok` does.
bool take_number(const char*& at, const char* end, char separator, double& value) {
  const char* from = at;
  while (from != end && is_blank(*from) && *from != separator) ++from;
  if (from != end && *from == '+') ++from;
  const auto [stop, error] = std::from_chars(from, end, value);
  if (error != std::errc()) return false;
  const char* next = stop;
  while (next != end && is_blank(*next) && *next != separator) ++next;
  const bool whole = next == end || *next == separator || (separator == ' ' && next != stop);
  if (whole) at = next;
  return whole;
}

/// Reads the wanted columns of one row after another.
class RowReader {
 public:
  RowReader(const RowLayout& layout, TraceFaults& faults)
      : layout_(layout), faults_(faults), numbers_(layout.columns.size()) {}

  /// The common case without a copy: points, no quotes, as many fields as there should be. Says
  /// nothing about a row that is different.
  bool read_plain(std::string_view row) {
    const char separator = layout_.dialect.separator;
    if (layout_.dialect.decimal != '.' || layout_.dialect.split_numbers) return false;
    const char* at = row.data();
    const char* const end = at + row.size();
    std::size_t wanted = 0;
    for (std::size_t field = 0; field < layout_.fields; ++field) {
      if (separator == ' ') {
        while (at != end && is_blank(*at)) ++at;
      }
      if (at == end) return false;
      if (wanted < layout_.columns.size() && layout_.columns[wanted] == field) {
        if (!take_number(at, end, separator, numbers_[wanted++])) return false;
      } else {
        while (at != end && *at != separator && !(separator == ' ' && *at == '\t')) {
          if (*at++ == '"') return false;
        }
      }
      if (at != end && separator != ' ') ++at;
    }
    if (separator == ' ') {
      while (at != end && is_blank(*at)) ++at;
    }
    return at == end || layout_.more_fields;
  }

  /// Any row; what is wrong with it goes to the faults. The rest of the text comes after it.
  bool read(std::string_view row, int line, std::string_view rest) {
    const std::vector<std::string_view> fields = split(row, layout_.dialect.separator);
    if (layout_.dialect.split_numbers) return join(fields, line, rest);
    if (fields.size() < layout_.fields ||
        (fields.size() > layout_.fields && !layout_.more_fields)) {
      faults_.add(line,
                  fmt::format("{} columns, there were {} before", fields.size(), layout_.fields));
      return false;
    }
    for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
      const std::string_view field = fields[layout_.columns[i]];
      const std::optional<double> value = number_of(field, layout_.dialect.decimal);
      if (!value) {
        faults_.add(line, field.empty() ? fmt::format("column {} is empty", layout_.names[i])
                                        : fmt::format("column {} = \"{}\" is no number",
                                                      layout_.names[i], field.substr(0, 40)));
        return false;
      }
      numbers_[i] = *value;
    }
    return true;
  }

  const std::vector<double>& numbers() const { return numbers_; }
  std::size_t guessed() const { return guessed_; }

 private:
  bool join(const std::vector<std::string_view>& fields, int line, std::string_view rest) {
    std::optional<JoinedRow> row = join_split_numbers(fields, layout_.fields, {});
    if (!row) row = join_split_numbers(fields, layout_.fields, expected_row(rest));
    if (!row) {
      faults_.add(line,
                  fmt::format("{} fields cannot be read as {} numbers with decimal commas, or "
                              "in more than one way: export with semicolons or tabs",
                              fields.size(), layout_.fields));
      return false;
    }
    follow(row->values);
    guessed_ += row->guessed ? 1 : 0;
    for (std::size_t i = 0; i < numbers_.size(); ++i) numbers_[i] = previous_[layout_.columns[i]];
    return true;
  }

  /// Keeps a row and the typical change from row to row.
  void follow(const std::vector<double>& row) {
    if (!previous_.empty()) {
      const bool first = changes_.empty();
      changes_.resize(row.size());
      for (std::size_t i = 0; i < row.size(); ++i) {
        const double change = std::abs(row[i] - previous_[i]);
        changes_[i] += (change - changes_[i]) * (first ? 1.0 : kNewest);
      }
    }
    previous_ = row;
  }

  /// Between the row before and the next one that can be read in one way only, if that is near.
  ExpectedRow expected_row(std::string_view rest) const {
    LineReader reader(rest);
    const int most = previous_.empty() ? kRowsLookedAt : kNearRows;
    for (int i = 0; i < most && reader.next(); ++i) {
      const std::optional<JoinedRow> row =
          join_split_numbers(split(reader.text(), layout_.dialect.separator), layout_.fields, {});
      if (!row) continue;
      std::vector<double> values = row->values;
      for (std::size_t k = 0; k < previous_.size(); ++k) {
        values[k] = 0.5 * (values[k] + previous_[k]);
      }
      return {std::move(values), changes_};
    }
    return {previous_, changes_};
  }

  const RowLayout& layout_;
  TraceFaults& faults_;
  std::vector<double> numbers_;
  std::vector<double> previous_;  ///< with numbers in two parts only
  std::vector<double> changes_;
  std::size_t guessed_ = 0;
};

void reserve(Rows& rows, std::string_view text, std::string_view first_row, std::size_t most) {
  const std::size_t expected = text.size() / (first_row.size() + 1) + 16;
  // More is for files whose rows grow shorter: they grow as vectors do.
  for (std::vector<double>& column : rows.values) column.reserve(std::min(expected, most));
}

}  // namespace

Rows read_rows(const std::string& file, LineReader& reader, const RowLayout& layout,
               const std::optional<TraceSelection::Range>& range, TraceFaults& faults) {
  Rows rows;
  rows.values.resize(layout.columns.size());
  const std::size_t most = kMostTraceValues / std::max<std::size_t>(layout.columns.size(), 1);
  const auto first = static_cast<std::size_t>(range ? range->first : 0);
  const std::size_t count =
      range ? static_cast<std::size_t>(range->count) : std::numeric_limits<std::size_t>::max();
  RowReader row(layout, faults);
  std::size_t index = 0;
  int last_line = -1;
  while (rows.size() < count && !faults.full() && reader.next()) {
    const std::string_view text = reader.text();
    const auto begins = [&](std::string_view end) { return text.starts_with(end); };
    if (std::any_of(layout.ends.begin(), layout.ends.end(), begins)) break;
    if (!row.read_plain(text)) {
      if (is_comment(text) || is_blank_row(text, layout.dialect.separator)) continue;
      const bool cut = reader.unfinished() && !layout.dialect.split_numbers &&
                       split(text, layout.dialect.separator).size() < layout.fields;
      if (cut) {
        rows.remarks.push_back(
            fmt::format("the end of the file cuts line {} off: it is left out", reader.number()));
        break;
      }
      if (!row.read(text, reader.number(), reader.rest())) continue;
    }
    if (index++ < first) continue;
    if (rows.size() == 0) reserve(rows, reader.rest(), text, std::min(most, count));
    if (rows.size() >= most) {
      throw core::InputError({file, reader.number()},
                             fmt::format("more than {} values: read fewer columns, or a part of it",
                                         kMostTraceValues));
    }
    if (reader.number() != last_line + 1) rows.lines.push_back({rows.size(), reader.number()});
    last_line = reader.number();
    for (std::size_t i = 0; i < rows.values.size(); ++i) {
      rows.values[i].push_back(row.numbers()[i]);
    }
  }
  if (row.guessed() > 0) {
    rows.remarks.push_back(fmt::format(
        "{} rows with whole numbers among decimal commas were read as what is close to the rows "
        "around: check them, or export with semicolons or tabs",
        row.guessed()));
  }
  return rows;
}

}  // namespace millstudy::io
