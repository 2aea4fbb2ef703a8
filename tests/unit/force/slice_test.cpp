// SPDX-License-Identifier: MIT
#include "force/slice.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "unit/force/cases.h"

namespace millstudy::force {
namespace {

Matrix43<double> axes_at(double phi, double kappa, double radius) {
  return edge_axes(std::sin(phi), std::cos(phi), std::sin(kappa), std::cos(kappa), radius);
}

TEST(EdgeAxes, AreOrthonormalForEveryEnvelope) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 1000; ++round) {
    const double phi = testing::uniform(random, -10.0, 10.0);
    const Matrix43<double> a = axes_at(phi, testing::uniform(random, 0.0, 1.6), 5.0);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double product = 0.0;
        for (int row = 0; row < 3; ++row) product += a[row][i] * a[row][j];
        EXPECT_NEAR(product, i == j ? 1.0 : 0.0, 1e-15);
      }
    }
  }
}

// A tooth at phi = 90 deg on the cylinder stands at +x and moves towards -y: the force on it
// pushes it back to -x (radial), to +y (tangential), and down (axial).
TEST(EdgeAxes, PushTheToolAwayFromTheChip) {
  const Matrix43<double> a = axes_at(0.5 * core::kPi, 0.5 * core::kPi, 6.0);
  EXPECT_NEAR(a[0][1], -1.0, 1e-15);
  EXPECT_NEAR(a[1][0], 1.0, 1e-15);
  EXPECT_NEAR(a[2][2], -1.0, 1e-15);
  EXPECT_EQ(a[3][0], 6.0);
}

// At the tip of a ball the radial force points up the axis, into the spindle.
TEST(EdgeAxes, TurnTheRadialForceIntoTheAxisAtTheTip) {
  const Matrix43<double> a = axes_at(0.3, 0.0, 0.0);
  EXPECT_EQ(a[0][1], 0.0);
  EXPECT_EQ(a[1][1], 0.0);
  EXPECT_EQ(a[2][1], 1.0);
}

}  // namespace
}  // namespace millstudy::force
