// SPDX-License-Identifier: MIT
#include "core/quadrature.h"

#include <cmath>
#include <gtest/gtest.h>

namespace millstudy::core {
namespace {

double integrate_power(const GaussRule& rule, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    sum += rule.weights[i] * std::pow(rule.nodes[i], power);
  }
  return sum;
}

TEST(GaussLegendre, IsExactUpToDegreeTwiceTheNodes) {
  for (int n = 1; n <= kLargestGaussRule; ++n) {
    const GaussRule& rule = gauss_legendre(n);
    EXPECT_NEAR(integrate_power(rule, 0), 2.0, 1e-15) << n;
    EXPECT_NEAR(integrate_power(rule, 2 * n - 2), 2.0 / (2 * n - 1), 1e-15) << n;
    EXPECT_NEAR(integrate_power(rule, 2 * n - 1), 0.0, 1e-15) << n;
  }
}

TEST(GaussLegendre, IsNotExactBeyond) {
  // The error of degree 2 n is known; a rule that is exact there would be no Gauss rule.
  const GaussRule& rule = gauss_legendre(3);
  EXPECT_GT(std::abs(integrate_power(rule, 6) - 2.0 / 7.0), 1e-3);
}

}  // namespace
}  // namespace millstudy::core
