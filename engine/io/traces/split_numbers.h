// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace millstudy::io {

/// One row of a file that writes decimals with a comma and separates by commas.
struct JoinedRow {
  std::vector<double> values;
  bool guessed = false;  ///< whole numbers among others leave more than one way: the closest
};

/// About what the numbers of a row are, by the rows around it.
struct ExpectedRow {
  std::vector<double> values;   ///< empty: not known
  std::vector<double> changes;  ///< typical ones from row to row; empty: all alike
};

/// Puts whole parts and decimals together: "0", "000000", "-0", "0131" are 0.0 and -0.0131.
///
/// A number without decimals takes one field only. A sign begins a number, decimals have none, and
/// a whole part has no leading zeros; of several ways that are left the one closest to what is
/// expected is taken, if it is four times closer than each other one.
///
/// @param fields    of the row
/// @param count     numbers there must be
/// @param expected  to choose by, where there is more than one way
/// @return nullopt if no way or more than one is left
std::optional<JoinedRow> join_split_numbers(std::span<const std::string_view> fields,
                                            std::size_t count, const ExpectedRow& expected);

/// Whether a field can be a part of such a number: digits, perhaps a sign or an exponent.
bool is_number_part(std::string_view field);

}  // namespace millstudy::io
