// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "path/interpolate.h"
#include "process/arc_set.h"
#include "process/bend.h"
#include "process/machining.h"
#include "process/stock.h"

namespace millstudy::process {

/// Where the teeth cut, in every interpolation period of a path.
///
/// Equations (M5) to (M9): the immersion follows the curvature of the path, and where the stock
/// begins and ends only what lies in it is cut. Arcs are those of the xy projection, at the middle
/// of the period.
class PathEngagement {
 public:
  /// @param path  must outlive this
  /// @throws core::InputError for an immersion whose radial depth is out of range
  PathEngagement(const path::Interpolation& path, const Machining& machining);

  /// @param i               period
  /// @param feed_direction  of it [rad]
  /// @return none, where nothing is cut, to three arcs
  ArcSet arcs(std::int64_t i, double feed_direction) const;

 private:
  double radius_;
  Immersion immersion_;
  ArcSet straight_;
  std::vector<Bend> bends_;  ///< shape (periods); empty for Side::constant
  std::optional<StockEnds> ends_;
};

}  // namespace millstudy::process
