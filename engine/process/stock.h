// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "path/interpolate.h"
#include "process/arc_set.h"

namespace millstudy::process {

/// Where along the path the stock ends.
enum class Stock {
  endless,  ///< the tool is in the stock all along
  entry,    ///< it comes in from the side: the stock begins one tool radius ahead of the start
  exit,     ///< it goes out: the stock ends at the end of the path
  both,
};

/// The faces in which a stock begins and ends: planes normal to the path's ends.
///
/// Equations (M8) and (M9). The face of the entry counts until the whole half circle 0 .. pi is
/// inside for the first time, that of the exit from the last time on, so that a path which comes
/// back to where it began is not cut twice. Tangents of the ends are those of the first and last
/// chord (of several, where the first ones are shorter than a tenth of the longest).
class StockEnds {
 public:
  /// @param radius  R of the tool [mm], > 0
  StockEnds(const path::Interpolation& path, double radius, Stock stock);

  /// What of a set lies in the stock at the middle of period i.
  /// @param feed_direction  of the period [rad]
  ArcSet within(const ArcSet& set, std::int64_t i, double feed_direction) const;

 private:
  /// A plane, and the side of it where the stock is.
  struct Face {
    path::Vec3 point;        ///< where the tool touches it from outside, on its axis
    double direction = 0.0;  ///< of the normal into the stock [rad]
    double offset = 0.0;     ///< of the plane from the point, along the normal [mm]
  };
  ArcSet within(const ArcSet& set, const Face& face, std::int64_t i, double feed_direction) const;
  bool is_inside(const Face& face, std::int64_t i) const;

  const path::Interpolation* path_;
  double radius_;
  Face entry_;
  Face exit_;
  std::int64_t entered_ = 0;  ///< first period that the entry's face does not touch
  std::int64_t leaving_ = 0;  ///< first period that the exit's face touches
};

}  // namespace millstudy::process
