// SPDX-License-Identifier: MIT
#include "dynamics/collocation.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

#include "dynamics/semi_discretization.h"
#include "dynamics/state_space.h"
#include "unit/dynamics/insperger.h"

namespace millstudy::dynamics {
namespace {

/// x'' + a1 x' + (delta + eps cos t) x = b x(t - 2 pi), a1 0.1, delta 3, eps 2, b -0.15.
DelaySystem delayed_mathieu() {
  DelaySystem system;
  const double delta = 3.0, frequency = std::sqrt(delta);
  system.machine = state_space({{{{frequency, 0.05 / frequency}, 1.0, 0.0}}, {}, {}});
  system.period = system.shortest_delay = system.longest_delay = 2.0 * core::kPi;
  system.breaks = {0.0};
  const auto only = [](double value) {
    return Eigen::Matrix2d(Eigen::Matrix2d::Identity() * value);
  };
  system.at = [=](double t) {
    return Gains{only(2.0 * std::cos(t)), {{2.0 * core::kPi, only(-0.15)}}};
  };
  system.averages = [=](int intervals) {
    AveragedGains gains;
    gains.delays = {2.0 * core::kPi};
    const double step = 2.0 * core::kPi / intervals;
    for (int i = 0; i < intervals; ++i) {
      gains.direct.push_back(only(2.0 * (std::sin((i + 1) * step) - std::sin(i * step)) / step));
      gains.delayed.push_back(only(-0.15));
    }
    return gains;
  };
  return system;
}

double radius(const LinearMap& map) {
  ArnoldiSettings settings;
  settings.tolerance = 1e-13;
  const DominantEigenvalue found = dominant_eigenvalue(map, settings);
  EXPECT_TRUE(found.converged) << found.residual;
  return std::abs(found.value);
}

// Value of a Chebyshev collocation that is stable to 14 digits.
TEST(Collocation, GivesTheRadiusOfTheDelayedMathieuEquation) {
  const double expected = 0.5120522840984;
  const DelaySystem system = delayed_mathieu();
  for (const int nodes : {4, 8, 12, 16}) {
    const double found = radius(CollocationMap(system, {nodes, 4.0}).map());
    std::cout << nodes << " nodes: off by " << found - expected << "\n";
    if (nodes >= 12) {
      EXPECT_NEAR(found, expected, 1e-12);
    }
  }
}

TEST(SemiDiscretization, TendsToTheRadiusOfTheDelayedMathieuEquation) {
  const double expected = 0.5120522840984;
  const DelaySystem system = delayed_mathieu();
  for (int order = 0; order <= 2; ++order) {
    const double coarse = radius(SemiDiscretizedMap(system, {400, order}).map()) - expected;
    const double fine = radius(SemiDiscretizedMap(system, {800, order}).map()) - expected;
    std::cout << "order " << order << ": off by " << coarse << " with 400, " << fine
              << " with 800 intervals\n";
    EXPECT_NEAR(coarse / fine, 4.0, 0.2);  // the error falls with the square
  }
}

// Richardson's extrapolation of the second-order method, as an independent limit.
TEST(Collocation, AgreesWithSemiDiscretizationOfManyIntervals) {
  for (const double rpm : {5000.0, 9000.0, 20000.0}) {
    const DelaySystem system = testing::insperger_slot(rpm, 1.0);
    const double coarse = radius(SemiDiscretizedMap(system, {2000, 0}).map());
    const double fine = radius(SemiDiscretizedMap(system, {4000, 0}).map());
    const double limit = fine + (fine - coarse) / 3.0;
    const double found = radius(CollocationMap(system, {16, 4.0}).map());
    std::cout << rpm << " rpm: off by " << found - limit << "\n";
    EXPECT_NEAR(found, limit, 1e-9);
  }
}

}  // namespace
}  // namespace millstudy::dynamics
