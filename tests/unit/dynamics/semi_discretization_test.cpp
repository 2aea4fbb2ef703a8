// SPDX-License-Identifier: MIT
#include "dynamics/semi_discretization.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

#include "unit/dynamics/insperger.h"

namespace millstudy::dynamics {
namespace {

double radius(const DelaySystem& system, SemiDiscretization settings) {
  const SemiDiscretizedMap map(system, settings);
  const DominantEigenvalue found = dominant_eigenvalue(map.map());
  EXPECT_TRUE(found.converged) << found.residual;
  return std::abs(found.value);
}

// Numbers of three independent programs, with the exact average of the coefficient.
TEST(SemiDiscretization, GivesTheSpectralRadiiOfInspergerAndStepan) {
  const double depth[] = {3.0, 6.0, 9.0}, expected[] = {1.62123, 2.96845, 40.2153};
  const double last_digit[] = {1e-5, 1e-5, 1e-4};
  for (int i = 0; i < 3; ++i) {
    const double found = radius(testing::insperger_slot(5000.0, depth[i]), {40, 0});
    std::cout << depth[i] << " mm: " << found << " off by " << found - expected[i] << "\n";
    EXPECT_NEAR(found, expected[i], 0.5 * last_digit[i]);
  }
}

}  // namespace
}  // namespace millstudy::dynamics
