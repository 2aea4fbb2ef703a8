// SPDX-License-Identifier: MIT
// Forced vibration and the surface that it leaves, against the frequency response, the simulation
// in time and closed forms.
#include "dynamics/surface.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <iostream>

#include "core/error.h"
#include "cutter/envelope.h"
#include "dynamics/floquet.h"
#include "dynamics/forced_vibration.h"
#include "dynamics/state_space.h"
#include "dynamics/time_domain.h"
#include "force/force_basis.h"
#include "unit/dynamics/insperger.h"
#include "unit/dynamics/random_cut.h"

namespace millstudy::dynamics {
namespace {

using testing::RandomCut;

constexpr double kFeed = 0.08;

std::function<Eigen::Vector2d(double)> force_of(const RandomCut& cut, double depth) {
  return [=](double t) {
    const auto rows = force::evaluate(
        force::force_basis(cut.cutter, {cut.arc.entry_angle, cut.arc.exit_angle, depth}, {},
                           cut.spindle_speed * t),
        cut.coefficients, {kFeed});
    return Eigen::Vector2d(rows[0], rows[1]);
  };
}

/// Stable cuts of random machines and cutters that leave a wall; equal: of flat cutters with equal
/// flutes.
std::vector<std::pair<RandomCut, double>> stable_cuts(int count, bool equal) {
  std::vector<std::pair<RandomCut, double>> all;
  std::mt19937_64 random(4711);
  while (static_cast<int>(all.size()) < count) {
    RandomCut cut = testing::random_cut(random);
    if (equal) {
      cut.cutter.shape = cutter::Shape::flat;
      if (cut.cutter.helix_angle == 0.0) cut.cutter.helix_angle = 0.4;  // no jumps of the force
      cut.cutter.pitch_angles.clear();
      cut.cutter.helix_angles.clear();
    }
    cut.coefficients.Kte = 10.0;
    cut.coefficients.Kre = 15.0;
    const bool wall = cut.arc.entry_angle == 0.0 || cut.arc.exit_angle > core::kPi - 1e-9;
    const double depth = 0.1 * cut.largest_depth;
    if (wall && floquet(cut.at(depth), {}).spectral_radius < 0.9) all.push_back({cut, depth});
  }
  return all;
}

Wall wall_of(const RandomCut& cut) {
  return cut.arc.entry_angle == 0.0 ? Wall::up : Wall::down;
}

// With equal flutes the position a tooth ago is the position now: no regeneration, and the motion
// is the frequency response times the harmonics of the force.
TEST(ForcedVibration, OfEqualFlutesIsTheFrequencyResponse) {
  double worst = 0.0;
  for (const auto& [cut, depth] : stable_cuts(12, true)) {
    const DelaySystem system = cut.at(depth);
    const auto force = force_of(cut, depth);
    const PeriodicMotion motion = forced_vibration(system, force, 1e-9);
    constexpr int kSamples = 8192, kHarmonics = 300;
    std::vector<Eigen::Vector2d> sampled;
    for (int i = 0; i < kSamples; ++i) sampled.push_back(force(system.period * i / kSamples));
    const double t = 0.37 * system.period;
    Eigen::Vector2cd sum = Eigen::Vector2cd::Zero();
    for (int k = -kHarmonics; k <= kHarmonics; ++k) {
      Eigen::Vector2cd harmonic = Eigen::Vector2cd::Zero();
      for (int i = 0; i < kSamples; ++i) {
        harmonic += std::polar(1.0 / kSamples, -2.0 * core::kPi * k * i / kSamples) * sampled[i];
      }
      const double omega = 2.0 * core::kPi * k / system.period;
      sum += frequency_response(cut.machine, omega) * harmonic *
             std::polar(1.0, 2.0 * core::kPi * k * 0.37);
    }
    worst = std::max(worst, (motion.at(t) - sum.real()).norm() / motion.largest());
  }
  std::cout << "off by at most " << worst << " of the largest displacement\n";
  EXPECT_LT(worst, 2e-5);  // of 300 harmonics and 8192 samples
}

TEST(ForcedVibration, RepeatsAndDoesNotDependOnTheTolerance) {
  double worst = 0.0, jump = 0.0;
  for (const auto& [cut, depth] : stable_cuts(12, false)) {
    const DelaySystem system = cut.at(depth);
    const PeriodicMotion rough = forced_vibration(system, force_of(cut, depth), 1e-3);
    const PeriodicMotion fine = forced_vibration(system, force_of(cut, depth), 1e-5);
    for (double t = 0.01; t < 1.0; t += 0.07) {
      const double off = (rough.at(t * system.period) - fine.at(t * system.period)).norm();
      worst = std::max(worst, off / fine.largest());
    }
    jump = std::max(
        jump, (fine.at(0.0) - fine.at(system.period * (1.0 - 1e-12))).norm() / fine.largest());
  }
  std::cout << "tolerance 1e-3: off by at most " << worst << "; end from beginning " << jump
            << "\n";
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(jump, 1e-5);
}

// Two methods that share neither discretization nor code: half a percent of the vibration.
TEST(MachinedWall, LocationErrorIsThatOfTheSimulation) {
  double worst = 0.0;
  for (const auto& [cut, depth] : stable_cuts(20, false)) {
    const force::CuttingEdges edges(cut.cutter, depth, {});
    const PeriodicMotion motion = forced_vibration(cut.at(depth), force_of(cut, depth), 1e-4);
    TimeDomain settings;
    settings.feed_per_tooth = kFeed;
    settings.tool_leaves_cut = false;
    settings.steps_per_cycle = 200;
    settings.decades = 6.0;
    const Simulated simulated =
        simulate(cut.machine, cut.cutter, {cut.arc.entry_angle, cut.arc.exit_angle, depth},
                 cut.coefficients, cut.spindle_speed, settings);
    const PeriodicMotion other(2.0 * core::kPi / cut.spindle_speed, simulated.last_turn);
    for (const double share : {0.0, 0.5, 1.0}) {
      const double z = share * depth;
      const double ours =
          MachinedWall(edges, motion, cut.spindle_speed, kFeed, wall_of(cut)).location_error(z);
      const double theirs =
          MachinedWall(edges, other, cut.spindle_speed, kFeed, wall_of(cut)).location_error(z);
      const double off = std::abs(ours - theirs) / motion.largest();
      worst = std::max(worst, off);
      EXPECT_LT(off, 5e-3) << cut;
    }
  }
  std::cout << "off by at most " << worst << " of the largest displacement\n";
}

// One mode across the feed: where the tooth frequency passes it, what resonates turns from along
// the force to against it.
TEST(MachinedWall, LocationErrorChangesSignAcrossTheSynchronousSpeed) {
  const auto error_at = [](double rpm) {
    RandomCut cut;
    cut.machine.y.push_back({{800.0 * 2.0 * core::kPi, 0.02}, 0.0, 1e4});
    cut.cutter = {cutter::Shape::flat, 12.0, 2, 0.0};
    cut.arc = force::down_milling(6.0, 0.6, 1.0).arc();
    cut.coefficients = testing::kInsperger;
    cut.spindle_speed = testing::spindle(rpm);
    const double depth = 0.2;
    const force::CuttingEdges edges(cut.cutter, depth, {});
    const PeriodicMotion motion = forced_vibration(cut.at(depth), force_of(cut, depth), 1e-8);
    return MachinedWall(edges, motion, cut.spindle_speed, kFeed, Wall::down).location_error(0.1);
  };
  const double synchronous = 800.0 * 60.0 / 2;  // a tooth each cycle
  const double below = error_at(0.98 * synchronous), above = error_at(1.02 * synchronous);
  std::cout << 1e3 * below << " um below, " << 1e3 * above << " um above\n";
  EXPECT_LT(below * above, 0.0);
}

// M.E. Martellotti, Trans. ASME 63 (1941) 677-700: arcs of trochoids, of radius R +- f N/(2 pi) ...
TEST(MachinedWall, FeedMarksOfARigidToolAreThoseOfTrochoids) {
  for (const Wall wall : {Wall::up, Wall::down}) {
    const cutter::Cutter cutter{cutter::Shape::flat, 12.0, 2, core::rad_from_deg(30.0)};
    const force::CuttingEdges edges(cutter, 1.0, {});
    const PeriodicMotion still(2.0 * core::kPi / 1000.0);
    const MachinedWall surface(edges, still, 1000.0, 0.1, wall);
    const Roughness found = roughness(surface.profile(0.4, 8192), surface.feed_per_turn(), 0.8);
    // X = v t + s R sin(w t): the height falls with (x/(1 + s v/(R w)))^2 / (2 R).
    const double v = 0.2 / (2.0 * core::kPi), stretch = 1.0 + (wall == Wall::up ? v : -v) / 6.0;
    const double rz = 0.1 * 0.1 / (8.0 * 6.0 * stretch * stretch);
    EXPECT_NEAR(found.rz, rz, 1e-3 * rz);
    EXPECT_NEAR(found.ra, rz * 4.0 / (9.0 * std::sqrt(3.0)), 1e-3 * rz);
    EXPECT_NEAR(found.rq, rz * 2.0 / (3.0 * std::sqrt(5.0)), 1e-3 * rz);
    EXPECT_NEAR(surface.location_error(0.4), 0.0, 1e-15);
  }
}

// A tooth that stands out by more than the feed mark is high is alone in what is left.
TEST(MachinedWall, RunoutLeavesTheMarksOfTheTeethThatStandOut) {
  cutter::Cutter cutter{cutter::Shape::flat, 12.0, 2, 0.0};
  cutter.runout.offset = 0.01;
  const force::CuttingEdges edges(cutter, 1.0, {});
  const PeriodicMotion still(2.0 * core::kPi / 1000.0);
  const MachinedWall surface(edges, still, 1000.0, 0.1, Wall::up);
  const double rz = roughness(surface.profile(0.5, 8192), surface.feed_per_turn(), 0.8).rz;
  const double stretch = 1.0 + 0.2 / (2.0 * core::kPi) / 6.01;
  const double expected = 0.2 * 0.2 / (8.0 * 6.01 * stretch * stretch);  // feed of a turn
  EXPECT_NEAR(rz, expected, 2e-3 * expected);
  EXPECT_NEAR(surface.location_error(0.5), 0.01, 1e-12);
}

TEST(Roughness, IsTheClosedFormOfASineAndDoesNotSeeOffsets) {
  std::vector<double> sine;
  for (int i = 0; i < 1000; ++i) sine.push_back(5.0 + std::sin(2.0 * core::kPi * i / 1000.0));
  const Roughness found = roughness(sine, 0.1, 0.8);
  EXPECT_NEAR(found.ra, 2.0 / core::kPi, 1e-5);
  EXPECT_NEAR(found.rq, std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(found.rz, 2.0, 1e-4);
}

TEST(CuspHeight, IsTheClosedFormOfBallAndBullNose) {
  const cutter::Envelope ball({cutter::Shape::ball, 12.0, 2, 0.0});
  for (const double step : {0.1, 1.0, 6.0, 11.9}) {
    const double expected = 6.0 - std::sqrt(36.0 - 0.25 * step * step);
    EXPECT_NEAR(cusp_height(ball, step), expected, 1e-12);
  }
  cutter::Cutter corner{cutter::Shape::bull_nose, 16.0, 2, 0.0};
  corner.corner_radius = 3.0;
  const cutter::Envelope bull_nose(corner);
  EXPECT_EQ(cusp_height(bull_nose, 9.0), 0.0);  // flats overlap
  const double half = 0.5 * 14.0 - 5.0;
  EXPECT_NEAR(cusp_height(bull_nose, 14.0), 3.0 - std::sqrt(9.0 - half * half), 1e-12);
  EXPECT_THROW(cusp_height(bull_nose, 17.0), core::CaseError);
}

}  // namespace
}  // namespace millstudy::dynamics
