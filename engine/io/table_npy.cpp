// SPDX-License-Identifier: MIT
#include <bit>
#include <fmt/core.h>
#include <ostream>
#include <string>

#include "io/table_format.h"

// The format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
namespace millstudy::io {
namespace {

static_assert(std::endian::native == std::endian::little, "fields are written as they are");

/// UTF-8 to code points; bytes that are no UTF-8 become U+FFFD.
std::u32string code_points(const std::string& text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    char32_t point = length == 1 ? lead : lead & (0x7fu >> length);
    bool good = (lead < 0x80 || lead >= 0xc2) && lead < 0xf5 && i + length <= text.size();
    for (std::size_t k = 1; good && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      good = (next & 0xc0) == 0x80;
      point = (point << 6) | (next & 0x3f);
    }
    points += good && point <= 0x10ffff ? point : U'\uFFFD';
    i += good ? length : 1;
  }
  return points;
}

/// A Python literal of the text.
std::string literal(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\x{:02x}", c);
      continue;
    }
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

/// Characters of the widest text of every column; 0 for columns of numbers.
std::vector<std::size_t> text_widths(const PointTable& table) {
  std::vector<std::size_t> widths(table.columns().size(), 0);
  bool any = false;
  for (std::size_t c = 0; c < widths.size(); ++c) {
    any = any || table.columns()[c].kind != PointColumn::Kind::number;
    if (table.columns()[c].kind != PointColumn::Kind::number) widths[c] = 1;
  }
  if (!any) return widths;
  for_rows(table, [&](const std::vector<Cells>& cells, std::size_t i) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto* texts = std::get_if<std::vector<std::string>>(&cells[c]);
      // Bytes are an upper bound of code points: only a longer text needs counting.
      if (texts == nullptr || (*texts)[i].size() <= widths[c]) continue;
      widths[c] = std::max(widths[c], code_points((*texts)[i]).size());
    }
  });
  return widths;
}

std::string header(const PointTable& table, const std::vector<std::size_t>& widths) {
  std::string text = "{'descr': [";
  for (std::size_t c = 0; c < widths.size(); ++c) {
    const std::string type = widths[c] == 0 ? "<f8" : fmt::format("<U{}", widths[c]);
    text += fmt::format("({}, '{}'), ", literal(table.columns()[c].name), type);
  }
  text += fmt::format("], 'fortran_order': False, 'shape': ({},), }}", table.points());
  constexpr std::size_t kPrefix = 12;  // magic, version 3.0 (UTF-8 names), length
  text.append(63 - (kPrefix + text.size()) % 64, ' ');
  text += '\n';
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string prefix("\x93NUMPY\x03\x00", 8);
  prefix.append(reinterpret_cast<const char*>(&length), sizeof(length));
  return prefix + text;
}

}  // namespace

void write_npy(const PointTable& table, std::ostream& out) {
  const std::vector<std::size_t> widths = text_widths(table);
  out << header(table, widths);
  std::string row;
  for_rows(table, [&](const std::vector<Cells>& cells, std::size_t i) {
    row.clear();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (const auto* texts = std::get_if<std::vector<std::string>>(&cells[c])) {
        std::u32string points = code_points((*texts)[i]);
        points.resize(widths[c], U'\0');
        row.append(reinterpret_cast<const char*>(points.data()), points.size() * 4);
      } else {
        const double value = std::get<std::vector<double>>(cells[c])[i];
        row.append(reinterpret_cast<const char*>(&value), sizeof(value));
      }
    }
    out << row;
  });
}

}  // namespace millstudy::io
