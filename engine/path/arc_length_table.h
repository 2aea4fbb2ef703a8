// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "path/curve.h"

namespace millstudy::path {

/// u as a function of arc length, equation (P18): a table at equal parameter steps, joined by
/// cubics with the slopes du/ds = 1/|R'|, limited to three secants so that u never runs back
/// (Fritsch and Carlson 1980); where |R'| = 0 the limit is the slope.
///
/// Measured on Table 1 of the paper with 1000 intervals: chords within 2e-7 of those of a table of
/// a million.
class ArcLengthTable {
 public:
  /// @param intervals  >= 1
  ArcLengthTable(const Curve& curve, int intervals);

  double length() const { return lengths_.back(); }          ///< [mm]
  std::int64_t evaluations() const { return evaluations_; }  ///< what the table cost

  /// The parameter at arc length s [mm], 0 <= s <= length(). Looks forward from the interval of
  /// the last call, which `hint` keeps.
  double parameter(double s, std::size_t& hint) const;

 private:
  std::vector<double> lengths_;     // s at the entries, shape (intervals + 1)
  std::vector<double> parameters_;  // u
  std::vector<double> slopes_;      // du/ds
  std::int64_t evaluations_ = 0;
};

}  // namespace millstudy::path
