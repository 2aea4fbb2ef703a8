// SPDX-License-Identifier: MIT
#include "io/traces/split_numbers.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "io/traces/text_dialect.h"

namespace millstudy::io {
namespace {

constexpr std::size_t kMostWays = 4096;
constexpr double kClearlyCloser = 4.0;
constexpr double kSmallestChange = 1e-12;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view without_sign(std::string_view field) {
  if (!field.empty() && (field.front() == '-' || field.front() == '+')) field.remove_prefix(1);
  return field;
}

bool is_whole_part(std::string_view field) {
  const std::string_view digits = without_sign(field);
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), is_digit)) return false;
  return digits.size() == 1 || digits.front() != '0';
}

bool is_decimals(std::string_view field) {
  return !field.empty() && is_digit(field.front()) && is_number_part(field);
}

/// All ways to read the fields as numbers, depth first.
class Ways {
 public:
  Ways(std::span<const std::string_view> fields, std::size_t count)
      : fields_(fields), count_(count) {
    go_on(0);
  }
  const std::vector<std::vector<double>>& found() const { return found_; }
  bool too_many() const { return steps_ > kMostWays; }

 private:
  void go_on(std::size_t field) {
    if (++steps_ > kMostWays) return;
    const std::size_t fields_left = fields_.size() - field;
    const std::size_t numbers_left = count_ - row_.size();
    if (fields_left == 0 && numbers_left == 0) found_.push_back(row_);
    if (fields_left < numbers_left || fields_left > 2 * numbers_left || numbers_left == 0) return;
    if (fields_left > numbers_left && is_whole_part(fields_[field]) &&
        is_decimals(fields_[field + 1])) {
      const std::string text = std::string(fields_[field]) + '.' + std::string(fields_[field + 1]);
      take(text, field + 2);
    }
    if (is_whole_part(fields_[field])) take(std::string(fields_[field]), field + 1);
  }
  void take(const std::string& text, std::size_t next) {
    const std::optional<double> value = number_of(text, '.');
    if (!value) return;
    row_.push_back(*value);
    go_on(next);
    row_.pop_back();
  }

  std::span<const std::string_view> fields_;
  std::size_t count_;
  std::size_t steps_ = 0;
  std::vector<double> row_;
  std::vector<std::vector<double>> found_;
};

/// How far a row is from what is expected, in typical changes from row to row, over the numbers in
/// which it differs from another row: the noise of the others says nothing.
double distance(std::span<const double> row, std::span<const double> other,
                const ExpectedRow& expected) {
  double sum = 0.0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == other[i]) continue;
    const double change = expected.changes.empty() ? 1.0 : expected.changes[i];
    sum += std::abs(row[i] - expected.values[i]) / std::max(change, kSmallestChange);
  }
  return sum;
}

}  // namespace

bool is_number_part(std::string_view field) {
  std::string_view rest = without_sign(field);
  const auto pass_digits = [&] {
    const std::size_t before = rest.size();
    while (!rest.empty() && is_digit(rest.front())) rest.remove_prefix(1);
    return rest.size() < before;
  };
  if (!pass_digits()) return false;
  if (rest.empty()) return true;
  if (rest.front() != 'e' && rest.front() != 'E') return false;
  rest = without_sign(rest.substr(1));
  return pass_digits() && rest.empty();
}

std::optional<JoinedRow> join_split_numbers(std::span<const std::string_view> fields,
                                            std::size_t count, const ExpectedRow& expected) {
  const Ways ways(fields, count);
  if (ways.found().empty() || ways.too_many()) return {};
  if (ways.found().size() == 1) return JoinedRow{ways.found().front()};
  if (expected.values.size() != count) return {};
  const std::vector<std::vector<double>>& rows = ways.found();
  // The best of all in every comparison, and clearly so; there may be none.
  for (const std::vector<double>& row : rows) {
    const bool clear = std::all_of(rows.begin(), rows.end(), [&](const auto& other) {
      return &other == &row ||
             distance(other, row, expected) >= kClearlyCloser * distance(row, other, expected);
    });
    if (clear) return JoinedRow{row, true};
  }
  return {};
}

}  // namespace millstudy::io
