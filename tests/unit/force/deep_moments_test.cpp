// SPDX-License-Identifier: MIT
// Moments of cuts of many helix turns, against the independent integral.
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

#include "force/sampler.h"
#include "unit/force/random_cutters.h"

namespace millstudy::force {
namespace {

TEST(Moments, AgreeWithAnIndependentIntegralWhateverTheDepth) {
  for (const cutter::Shape shape : {cutter::Shape::flat, cutter::Shape::ball}) {
    for (const double turns : {1.0, 8.0, 12.0, 30.0, 100.0}) {
      reference::Cut cut;
      cut.cutter = {shape, 15.0, 9, core::rad_from_deg(70.0)};
      cut.axial_depth = turns * core::kPi * 15.0 / std::tan(cut.cutter.helix_angle);
      cut.arcs = {{2.35, 3.07}};
      cut.feed.per_tooth = 0.145;
      cut.coefficients = testing::kGgg70;
      const reference::Tool tool(cut.cutter);
      const ForceSampler sampler(cut.cutter, {2.35, 3.07, cut.axial_depth}, {}, 1, {}, true);
      double off = 0.0, peak = 0.0;
      for (int i = 0; i < 6; ++i) {
        const double phi = 0.1 + 1.1 * i;
        const double c = std::cos(phi), s = std::sin(phi);
        ForceSamples out;
        sampler.sample_moments(cut.coefficients, {0.145, phi}, 0, 1, out);
        const reference::Load load = reference::load(tool, cut, phi, 1e-9);
        off = std::max(off, std::abs(out.x[0] * c + out.y[0] * s - load[4]));
        off = std::max(off, std::abs(out.y[0] * c - out.x[0] * s - load[5]));
        peak = std::max({peak, std::abs(load[4]), std::abs(load[5])});
      }
      EXPECT_LT(off, 1e-11 * peak) << turns << " turns";
      std::cout << "moments over " << turns << " turns: " << off / peak << " of the peak\n";
    }
  }
}

}  // namespace
}  // namespace millstudy::force
