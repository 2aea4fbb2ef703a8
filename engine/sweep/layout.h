// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace millstudy::sweep {

/// One result variable: a double for every point, NaN where a point has none.
struct Column {
  std::string name;             ///< as in the file: force_x_mean
  std::string units;            ///< UDUNITS: N, mm, percent, 1
  std::string long_name;        ///< for plots: "mean force on the tool along x"
  bool may_be_missing = false;  ///< NaN is no failure: not every point has this
};

/// The values that one parameter takes.
struct Coordinate {
  std::string name;  ///< last part of its dotted key; the whole key with underscores on a collision
  std::string key;   ///< dotted key of the study: cut.feed_rate_mm_per_min
  std::string units;
  std::string long_name;
  std::variant<std::vector<double>, std::vector<std::string>> values;
};

/// Says where a result came from: name and value.
using Attribute = std::pair<std::string, std::variant<std::string, std::int64_t, double>>;

/// Everything about a result file but the results.
///
/// A grid has one dimension per coordinate, named and scaled by it, in the order of the study; zip
/// and sampled designs have the one dimension "point" with every coordinate on it; a study without
/// a sweep has no dimension, and its variables are scalars. Points are numbered in row-major order.
struct Layout {
  std::vector<std::string> dimensions;  ///< names, outermost first
  std::vector<std::int64_t> shape;      ///< their lengths, same size as dimensions
  std::vector<Coordinate> coordinates;
  std::vector<Column> columns;
  bool traces = false;
  std::vector<Attribute> attributes;  ///< known before the run: title, study, study_hash, ...
  std::int64_t points_here = 0;       ///< of a part of a study, about; 0: all
  std::vector<std::int64_t> chunk;    ///< what a file of it packs together; empty: not known

  std::int64_t points() const {
    std::int64_t product = 1;
    for (const std::int64_t length : shape) product *= length;
    return product;
  }
};

}  // namespace millstudy::sweep
