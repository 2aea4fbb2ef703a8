// SPDX-License-Identifier: MIT
#include "force/part_series.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

#include "core/units.h"

namespace millstudy::force {
namespace {

/// Largest error of heights over that of the top, and of slopes over the height of the piece.
struct Errors {
  double height = 0.0;
  double slope = 0.0;
};

Errors errors_of(const cutter::Cutter& cutter, double depth) {
  const CuttingEdges edges(cutter, depth, {});
  const cutter::Envelope& envelope = edges.envelope();
  Errors worst;
  for (const EdgePiece& piece : edges.pieces()) {
    const PartSeries series = height_series(envelope, piece);
    const double lag = envelope.lag(piece.bottom), range = envelope.lag(piece.top) - lag;
    for (int i = 0; i <= 1000; ++i) {
      const double part = 1e-3 * i;
      const PartSeries::At found = series.at(Lanes{} + part);
      const double z = envelope.height_at_lag(lag + part * range);
      const double from_middle = z - 0.5 * (piece.bottom + piece.top);
      worst.height = std::max(worst.height, std::abs(found.value[0] - from_middle) / piece.top);
      // At a corner the slope of the envelope is that of the piece above.
      const double inside = std::clamp(z, piece.bottom + 1e-9, piece.top - 1e-9);
      worst.slope =
          std::max(worst.slope, std::abs(found.slope[0] - range / envelope.lag_slope(inside)) /
                                    (piece.top - piece.bottom));
    }
  }
  return worst;
}

TEST(HeightSeries, IsTheHeightOfALag) {
  cutter::Cutter taper{cutter::Shape::taper, 12.0, 2, core::rad_from_deg(40.0)};
  taper.taper_angle = core::rad_from_deg(25.0);
  taper.corner_radius = 2.0;
  cutter::Cutter ball{cutter::Shape::ball, 12.0, 2, core::rad_from_deg(30.0)};
  for (const auto lead : {cutter::Lead::constant_lead, cutter::Lead::constant_helix}) {
    taper.lead = lead;
    for (const cutter::Cutter& cutter : {taper, ball}) {
      const Errors worst = errors_of(cutter, 15.0);
      std::cout << "height of a lag: " << worst.height << ", slope " << worst.slope << "\n";
      EXPECT_LT(worst.height, 5e-15);
      EXPECT_LT(worst.slope, 1e-9);
    }
  }
}

}  // namespace
}  // namespace millstudy::force
