// SPDX-License-Identifier: MIT
// What stability must do whatever the method: limits, symmetries, scaling.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

#include "dynamics/depth_limit.h"
#include "dynamics/floquet.h"
#include "dynamics/semi_discretization.h"
#include "unit/dynamics/insperger.h"
#include "unit/dynamics/random_cut.h"

namespace millstudy::dynamics {
namespace {

using testing::RandomCut;

std::vector<RandomCut> cuts(int count) {
  std::vector<RandomCut> all;
  std::mt19937_64 random(77);
  for (int i = 0; i < count; ++i) all.push_back(testing::random_cut(random));
  return all;
}

double radius(const RandomCut& cut, double depth) {
  return floquet(cut.at(depth), {1e-9}).spectral_radius;
}

double limit(const RandomCut& cut) {
  DepthSearch search;
  search.largest_depth = cut.largest_depth;
  search.tolerance = 1e-6;
  return depth_limits([&](double depth) { return cut.at(depth); }, search).axial_depth_limit;
}

TEST(Stability, WithoutCoefficientsOnlyTheMachineDecays) {
  for (RandomCut cut : cuts(20)) {
    cut.coefficients = {};
    double slowest = 1e300;
    for (const std::vector<AxisMode>* axis : {&cut.machine.x, &cut.machine.y}) {
      for (const AxisMode& mode : *axis) {
        slowest = std::min(slowest, mode.mode.damping_ratio * mode.mode.natural_frequency);
      }
    }
    const double expected = std::exp(-slowest * cut.at(1.0).period);
    EXPECT_NEAR(radius(cut, 1.0), expected, 1e-9 * expected) << cut;
  }
}

TEST(Stability, LeftHandHelixGivesTheRadiusOfTheRightHand) {
  int compared = 0;
  for (RandomCut cut : cuts(60)) {
    if (cut.cutter.shape != cutter::Shape::flat || cut.cutter.helix_angle == 0.0) continue;
    if (!cut.cutter.helix_angles.empty() || !cut.cutter.pitch_angles.empty()) continue;
    const double right = radius(cut, 0.5 * cut.largest_depth);
    cut.cutter.helix_angle = -cut.cutter.helix_angle;
    EXPECT_NEAR(radius(cut, 0.5 * cut.largest_depth), right, 1e-8 * right) << cut;
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST(Stability, PitchThatIsNearlyEqualGivesTheRadiusOfEqualPitch) {
  for (RandomCut cut : cuts(12)) {
    cut.cutter.helix_angles.clear();
    cut.cutter.pitch_angles.clear();
    if (cut.cutter.flutes == 1) continue;
    const double depth = 0.1 * cut.largest_depth;
    const double equal = std::pow(radius(cut, depth), cut.cutter.flutes);  // of a turn
    cut.cutter.pitch_angles.assign(cut.cutter.flutes, 2.0 * core::kPi / cut.cutter.flutes);
    EXPECT_NEAR(radius(cut, depth), std::pow(equal, 1.0 / cut.cutter.flutes), 1e-12 * equal);
    cut.cutter.pitch_angles[0] += 1e-8;
    cut.cutter.pitch_angles[1] -= 1e-8;
    EXPECT_NEAR(radius(cut, depth), equal, 1e-5 * equal) << cut;
  }
}

TEST(Stability, LimitGoesWithOneOverTheCoefficientsAtZeroHelix) {
  for (RandomCut cut : cuts(12)) {
    if (cut.cutter.shape != cutter::Shape::flat) continue;
    cut.cutter.helix_angle = 0.0;
    cut.cutter.helix_angles.clear();
    cut.largest_depth = 100.0;
    const double whole = limit(cut);
    cut.coefficients.Ktc *= 2.0;
    cut.coefficients.Krc *= 2.0;
    EXPECT_NEAR(limit(cut), 0.5 * whole, 2e-5 * whole) << cut;
  }
}

// Stiffness and force grow alike: N to kN. Lengths in metres: what a user could mix up.
TEST(Stability, LimitIsIndependentOfUnits) {
  for (const RandomCut& cut : cuts(12)) {
    const double millimetres = limit(cut);
    RandomCut heavy = cut, metres = cut;
    for (std::vector<AxisMode>* axis : {&heavy.machine.x, &heavy.machine.y}) {
      for (AxisMode& mode : *axis) mode.stiffness *= 1e3;
    }
    heavy.coefficients.Ktc *= 1e3;
    heavy.coefficients.Krc *= 1e3;
    heavy.coefficients.Kac *= 1e3;
    EXPECT_NEAR(limit(heavy), millimetres, 1e-5 * millimetres) << cut;
    for (std::vector<AxisMode>* axis : {&metres.machine.x, &metres.machine.y}) {
      for (AxisMode& mode : *axis) mode.stiffness *= 1e3;
    }
    metres.coefficients.Ktc *= 1e6;
    metres.coefficients.Krc *= 1e6;
    metres.coefficients.Kac *= 1e6;
    metres.cutter.diameter *= 1e-3;
    metres.cutter.corner_radius *= 1e-3;
    metres.largest_depth *= 1e-3;
    EXPECT_NEAR(limit(metres), 1e-3 * millimetres, 1e-8 * millimetres) << cut;
  }
}

TEST(Stability, FlipLobesChatterAtHalfTheToothFrequency) {
  int flips = 0;
  for (double rpm = 8000.0; rpm < 30000.0; rpm += 500.0) {
    const DelaySystem system = testing::insperger_down(0.05, rpm, 8.5);
    const Floquet found = floquet(system, {1e-6});
    if (found.spectral_radius < 1.0 || found.kind != Bifurcation::flip) continue;
    ++flips;
    const double halves = found.chatter_frequency * system.period / core::kPi;
    EXPECT_NEAR(halves, std::round(halves), 1e-6);
    EXPECT_EQ(std::lround(halves) % 2, 1) << rpm;
  }
  std::cout << flips << " unstable flips\n";
  EXPECT_GE(flips, 3);
}

TEST(Stability, StructuredProductsGiveTheEigenvaluesOfTheDenseMap) {
  for (const RandomCut& cut : cuts(12)) {
    const SemiDiscretizedMap map(cut.at(0.2 * cut.largest_depth), {60, 0});
    Eigen::MatrixXd dense(map.size(), map.size());
    for (int i = 0; i < map.size(); ++i) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(map.size(), i);
      map.apply(unit.data(), dense.col(i).data());
    }
    const double expected = dense.eigenvalues().cwiseAbs().maxCoeff();
    const double found = std::abs(dominant_eigenvalue(map.map()).value);
    EXPECT_NEAR(found, expected, 1e-9 * expected) << cut;
  }
}

// Semi-discretization, its error of second order extrapolated away, against collocation.
TEST(Stability, MethodsAgreeOnRandomCuts) {
  double worst[3] = {}, extrapolated[3] = {};
  for (const RandomCut& cut : cuts(20)) {
    const DelaySystem system = cut.at(0.2 * cut.largest_depth);
    const double expected = floquet(system, {1e-8}).spectral_radius;
    for (int order = 0; order <= 2; ++order) {
      const double coarse = floquet(system, {1e-3, 2000, order}).spectral_radius;
      const double fine = floquet(system, {1e-3, 4000, order}).spectral_radius;
      const double limit = fine + (fine - coarse) / 3.0;
      worst[order] = std::max(worst[order], std::abs(fine / expected - 1.0));
      extrapolated[order] = std::max(extrapolated[order], std::abs(limit / expected - 1.0));
    }
  }
  EXPECT_LT(extrapolated[2], 5e-4);
  for (int order = 0; order <= 2; ++order) {
    std::cout << "4000 intervals of order " << order << ": off by at most " << worst[order]
              << ", extrapolated from 2000 by " << extrapolated[order] << "\n";
    EXPECT_LT(worst[order], 0.02);
  }
}

}  // namespace
}  // namespace millstudy::dynamics
