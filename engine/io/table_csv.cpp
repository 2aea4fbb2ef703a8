// SPDX-License-Identifier: MIT
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>
#include <string>

#include "io/table_format.h"

namespace millstudy::io {
namespace {

/// RFC 4180: in quotes where a comma, a quote or a line end is inside.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

void add_number(double value, std::string& line) {
  if (std::isnan(value)) return;
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  line.append(digits.data(), end);
}

std::string title(const PointColumn& column) {
  const bool number = column.kind == PointColumn::Kind::number;
  if (!number || column.units.empty() || column.units == "1") return column.name;
  return column.name + " [" + column.units + "]";
}

}  // namespace

void write_csv(const PointTable& table, std::ostream& out) {
  std::string line;
  for (const PointColumn& column : table.columns()) {
    if (!line.empty()) line += ',';
    line += quoted(title(column));
  }
  line += '\n';
  out << line;
  for_rows(table, [&](const std::vector<Cells>& cells, std::size_t i) {
    line.clear();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (c > 0) line += ',';
      if (const auto* texts = std::get_if<std::vector<std::string>>(&cells[c])) {
        line += quoted((*texts)[i]);
      } else {
        add_number(std::get<std::vector<double>>(cells[c])[i], line);
      }
    }
    line += '\n';
    out << line;
  });
}

}  // namespace millstudy::io
