// SPDX-License-Identifier: MIT
#include "force/revolution_mean.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "unit/force/cases.h"
#include "unit/force/random_cutters.h"

namespace millstudy::force {
namespace {

TEST(RevolutionMean, IsTheSlotFormulaOfAFlatEndMill) {
  // Altintas, Manufacturing Automation, 2nd ed., (2.31)-(2.33), on the tool.
  const cutter::Cutter cutter{cutter::Shape::flat, 25.0, 2, core::rad_from_deg(45.0)};
  const ForceBasis mean = revolution_mean(cutter, slot(3.0));
  const double n = 2.0, a = 3.0;
  EXPECT_NEAR(mean.chip[1][0], n * a / 4.0, 1e-14);
  EXPECT_NEAR(mean.chip[0][1], -n * a / 4.0, 1e-14);
  EXPECT_NEAR(mean.chip[2][2], -n * a / core::kPi, 1e-14);
  EXPECT_NEAR(mean.edge[1][0], n * a / core::kPi, 1e-14);
  EXPECT_NEAR(mean.edge[0][1], -n * a / core::kPi, 1e-14);
  EXPECT_NEAR(mean.edge[2][2], -n * a / 2.0, 1e-14);
  EXPECT_NEAR(mean.chip[0][0], 0.0, 1e-14);
  EXPECT_NEAR(mean.edge[1][1], 0.0, 1e-14);
}

TEST(RevolutionMean, IsTheMeanOfTheForce) {
  std::mt19937_64 random(21);
  double worst = 0.0;
  for (int i = 0; i < 40; ++i) {
    const reference::Cut cut =
        testing::random_cut(random, static_cast<testing::Kind>(random() % 8));
    cutter::Cutter cutter = cut.cutter;
    cutter.runout = {};
    const Engagement engagement{cut.arcs[0].entry_angle, cut.arcs[0].exit_angle, cut.axial_depth};
    const ForceBasis mean = revolution_mean(cutter, engagement);
    // Kinks of the force leave an error of one over the square of the number of angles.
    constexpr int kAngles = 20000;
    ForceBasis sum;
    for (int n = 0; n < kAngles; ++n) {
      const ForceBasis at =
          force_basis(cutter, engagement, {}, 2.0 * core::kPi * (n + 0.5) / kAngles);
      for (int row = 0; row < kRows; ++row) {
        for (int c = 0; c < kColumns; ++c) {
          sum.chip[row][c] += at.chip[row][c] / kAngles;
          sum.edge[row][c] += at.edge[row][c] / kAngles;
        }
      }
    }
    double size = 0.0, wrong = 0.0;
    for (int row = 0; row < 3; ++row) {
      for (int c = 0; c < kColumns; ++c) {
        size = std::max({size, std::abs(mean.chip[row][c]), std::abs(mean.edge[row][c])});
        wrong = std::max({wrong, std::abs(mean.chip[row][c] - sum.chip[row][c]),
                          std::abs(mean.edge[row][c] - sum.edge[row][c])});
      }
    }
    if (cutter.helix_angle != 0.0) worst = std::max(worst, wrong / size);
    // An edge without helix enters at once: a step, of which the sum knows one angle's width.
    EXPECT_LT(wrong, (cutter.helix_angle != 0.0 ? 1e-4 : 2e-3) * size);
  }
  std::printf("worst against sums over 20000 angles: %.1e\n", worst);
}

}  // namespace
}  // namespace millstudy::force
