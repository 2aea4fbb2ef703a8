// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/hdf5.h"

namespace millstudy::io {

/// Values of one column at successive points: numbers, or texts.
using Cells = std::variant<std::vector<double>, std::vector<std::string>>;

/// One column of a result seen as a table with a row for every point.
struct PointColumn {
  enum class Kind { number, text, status, failure };
  std::string name;
  std::string units;
  std::string long_name;
  std::string study_key;  ///< of a coordinate: the key of the study that it gives
  Kind kind = Kind::number;
  hdf5::Handle dataset;
  /// Coordinate of a grid: all its values, and how many points each lasts; 0 if it varies by point.
  Cells values;
  std::int64_t stride = 0;
};

/// A result file as a table: coordinates first, then the variables in the order of the file, then
/// status and the reason of failure. Read in pieces, so memory does not grow with the points.
class PointTable {
 public:
  /// @throws core::InputError if the file is no result; hdf5::Error if it is damaged
  explicit PointTable(const std::string& path);

  std::int64_t points() const { return points_; }
  const Shape& shape() const { return shape_; }
  /// Of the chunks of status; empty if these are no runs of the row-major order.
  const Shape& chunk() const { return chunk_; }
  const std::vector<std::string>& dimensions() const { return dimensions_; }
  /// A variable of the file that takes no value per point, such as the samples of traces.
  /// @throws hdf5::Error if there is none
  hdf5::Handle other(const std::string& name) const;
  const std::vector<PointColumn>& columns() const { return columns_; }

  /// Fills `to` with the numbers of points begin, begin + 1, ... as they are stored: of status and
  /// failure the codes.
  void read_numbers(const PointColumn& column, std::int64_t begin, std::span<double> to) const;
  /// What the code of a failure says; empty of none.
  std::string reason(double code) const;
  /// Cells of points begin .. begin + count - 1: texts for texts, status ("ok", ...) and failure
  /// (empty where none), numbers for the rest.
  Cells read(const PointColumn& column, std::int64_t begin, std::int64_t count) const;

 private:
  void add_coordinates();
  void add_variables();

  std::string path_;
  hdf5::Handle file_;
  Shape shape_;
  Shape chunk_;
  std::vector<haddr_t> scales_;          // of the dimensions
  std::vector<std::string> dimensions_;  // their names
  std::int64_t points_ = 1;
  std::vector<std::string> reasons_;
  std::vector<PointColumn> columns_;
};

}  // namespace millstudy::io
