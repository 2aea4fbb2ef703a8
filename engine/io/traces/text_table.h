// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/trace_file.h"
#include "io/traces/source.h"
#include "io/traces/text_dialect.h"

namespace millstudy::io {

/// One column of a text file. Without a heading its name is its number from 1.
struct TextColumn {
  std::string name;
  std::string unit;
};

/// Where the numbers of a text file are, and what stands above them.
struct TextTable {
  TextDialect dialect;
  std::vector<TextColumn> columns;
  std::string_view header;  ///< the lines above the numbers
  std::string_view rows;    ///< from the first row of numbers to the end
  int line_before = 0;      ///< number of the last line of the header
};

/// "Fx [N]" and "Fx (N)" give the name Fx and the unit N.
TextColumn parse_heading(std::string_view text);

/// Seconds in a unit of time (s, ms, us, min, h).
std::optional<double> seconds_per_unit(std::string_view unit);

/// Finds the first row that is all numbers, the row after it having as many, and the headings above
/// it: a line of names, and a line of units if there is one.
///
/// @throws core::InputError if there are no numbers, or the text is UTF-16
TextTable find_table(const Source& source);

/// Reads what is selected of a table; the time column is found by its name or unit.
///
/// @throws core::InputError, see read_trace_file
identify::ChannelSet read_table(const Source& source, const TextTable& table,
                                const TraceSelection& selection);

/// A column by name (letters of either case if it is the only such) or by number from 1.
/// @throws core::InputError naming the columns there are
std::size_t find_column(const Source& source, const std::vector<TextColumn>& columns,
                        const std::string& wanted);

/// Which columns a selection takes: channel to be, column. One of them may be the time.
struct ColumnChoice {
  std::vector<std::string> names;    ///< of the channels to be
  std::vector<std::size_t> columns;  ///< of the same channels
  std::optional<std::size_t> time;   ///< column of the time
};
ColumnChoice choose_columns(const Source& source, const std::vector<TextColumn>& columns,
                            const TraceSelection& selection);

}  // namespace millstudy::io
