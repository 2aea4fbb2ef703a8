// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <iosfwd>
#include <vector>

#include "io/point_table.h"

namespace millstudy::io {

/// The formats of export_table.
void write_csv(const PointTable& table, std::ostream& out);
void write_npy(const PointTable& table, std::ostream& out);

/// Calls row(cells of all columns, index within them) for every point, reading in pieces.
template <class Row>
void for_rows(const PointTable& table, const Row& row) {
  constexpr std::int64_t kPiece = 1 << 14;  // 16 k points of 30 columns are 4 MB
  for (std::int64_t begin = 0; begin < table.points(); begin += kPiece) {
    const std::int64_t count = std::min(kPiece, table.points() - begin);
    std::vector<Cells> cells;
    for (const PointColumn& column : table.columns()) {
      cells.push_back(table.read(column, begin, count));
    }
    for (std::int64_t i = 0; i < count; ++i) row(cells, static_cast<std::size_t>(i));
  }
}

}  // namespace millstudy::io
