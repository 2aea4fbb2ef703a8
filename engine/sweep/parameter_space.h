// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace millstudy::sweep {

/// How the values of the axes are combined into points.
enum class Design {
  grid,             ///< every combination, the last axis varying fastest
  zip,              ///< the i-th value of every axis together; all axes have one length
  latin_hypercube,  ///< a zip of axes that were sampled so
  sobol,            ///< likewise
  saltelli,         ///< likewise
};

inline constexpr std::int64_t kMostPoints = 1'000'000'000;

/// The points of a study: a pure function from a point's number to one index per axis.
class ParameterSpace {
 public:
  /// @param lengths  number of values of each axis, each >= 1; none is a single point
  /// @throws core::InputError for unequal lengths in a zip, or more than kMostPoints points
  ParameterSpace(Design design, std::vector<std::int64_t> lengths);

  std::int64_t points() const { return points_; }
  Design design() const { return design_; }
  std::size_t axes() const { return lengths_.size(); }

  /// Index into each axis of one point, 0 <= point < points(); out has shape (axes).
  void indices(std::int64_t point, std::span<std::int64_t> out) const;

 private:
  Design design_;
  std::vector<std::int64_t> lengths_;
  std::int64_t points_ = 1;
};

}  // namespace millstudy::sweep
