// SPDX-License-Identifier: MIT
#include "dynamics/depth_limit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

#include "dynamics/arnoldi.h"
#include "dynamics/floquet.h"
#include "unit/dynamics/insperger.h"
#include "unit/dynamics/random_cut.h"

namespace millstudy::dynamics {
namespace {

struct Limit {
  double immersion;
  double rpm;
  double at_40;
  double at_100;
};

// Computed by two independent programs after Insperger & Stepan 2004, down-milling, order 0.
constexpr Limit kLimits[] = {
    {1.0, 5000, 0.480, 0.419},   {1.0, 10000, 0.335, 0.324},  {1.0, 15000, 0.393, 0.388},
    {1.0, 20000, 1.428, 1.419},  {1.0, 25000, 3.938, 3.940},  {0.05, 5000, 2.312, 2.224},
    {0.05, 10000, 4.109, 4.098}, {0.05, 15000, 8.102, 8.200}, {0.05, 20000, 2.293, 2.300},
    {0.05, 25000, 2.922, 2.917},
};

double limit(const Limit& at, int intervals, double tolerance = 1e-3) {
  DepthSearch search;
  search.intervals = intervals;
  search.tolerance = tolerance;
  return depth_limits(
             [&](double depth) { return testing::insperger_down(at.immersion, at.rpm, depth); },
             search)
      .axial_depth_limit;
}

TEST(DepthLimit, AgreesWithTheLimitsOfInspergerAndStepan) {
  for (const Limit& at : kLimits) {
    const double at_40 = limit(at, 40), at_100 = limit(at, 100);
    std::cout << "immersion " << at.immersion << ", " << at.rpm << " rpm: " << at_40 << " -> "
              << at_100 << " mm, off by " << 100.0 * (at_40 / at.at_40 - 1.0) << " % and "
              << 100.0 * (at_100 / at.at_100 - 1.0) << " %\n";
    EXPECT_NEAR(at_40, at.at_40, 5e-3 * at.at_40);
    EXPECT_NEAR(at_100, at.at_100, 5e-3 * at.at_100);
  }
}

TEST(DepthLimit, DoesNotMoveWhenTheToleranceIsHalved) {
  for (const Limit& at : kLimits) {
    const double found = limit(at, 0, 1e-3), half = limit(at, 0, 5e-4), fine = limit(at, 0, 1e-7);
    std::cout << "immersion " << at.immersion << ", " << at.rpm << " rpm: " << found
              << " mm, off by " << found / fine - 1.0 << " and " << half / fine - 1.0 << "\n";
    EXPECT_NEAR(found, half, 1e-3 * half);
    EXPECT_NEAR(found, fine, 5e-4 * fine);
  }
}

// Deep in this cut a disturbance grows beyond all numbers within a turn.
TEST(DepthLimit, IsFoundBelowDepthsAtWhichNumbersOverflow) {
  std::mt19937_64 random(1416);
  const testing::RandomCut cut = testing::random_cut(random);
  EXPECT_EQ(floquet(cut.at(cut.largest_depth), {}).spectral_radius, kLargestGrowth);
  DepthSearch search;
  search.largest_depth = cut.largest_depth;
  const double limit =
      depth_limits([&](double depth) { return cut.at(depth); }, search).axial_depth_limit;
  EXPECT_LT(floquet(cut.at(0.99 * limit), {}).spectral_radius, 1.0);
  EXPECT_GT(floquet(cut.at(1.01 * limit), {}).spectral_radius, 1.0);
}

}  // namespace
}  // namespace millstudy::dynamics
