// SPDX-License-Identifier: MIT
// Process damping (D26), by every method.
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

#include "core/error.h"
#include "dynamics/depth_limit.h"
#include "dynamics/floquet.h"
#include "dynamics/time_domain.h"
#include "dynamics/zeroth_order.h"
#include "unit/dynamics/insperger.h"
#include "unit/dynamics/random_cut.h"

namespace millstudy::dynamics {
namespace {

using testing::RandomCut;

/// Cuts in which damping counts: forces of the order of the machine's own damping and above.
std::vector<RandomCut> damped_cuts(int count) {
  std::vector<RandomCut> all;
  std::mt19937_64 random(78);
  std::uniform_real_distribution<double> uniform;
  while (static_cast<int>(all.size()) < count) {
    RandomCut cut = testing::random_cut(random);
    cut.process_damping = std::pow(10.0, 1.0 + 2.0 * uniform(random));
    // Radii beyond this are known to fewer digits.
    if (radius_at_level(cut.at(0.4 * cut.largest_depth), 3, 1e-6).value < 50.0) all.push_back(cut);
  }
  return all;
}

// A slot with four teeth without cutting forces: the damping is constant, that of N/4 teeth.
TEST(ProcessDamping, IsAddedToTheModeWhereItIsConstant) {
  const double depth = 2.0, damping = 300.0, speed = testing::spindle(900.0), mass = 0.04e-3;
  const Mode mode = {922.0 * 2.0 * core::kPi, 0.011};
  const Machine machine = {{{mode, mass, 0.0}}, {}, {}};
  for (const double helix : {0.0, 0.6}) {
    const cutter::Cutter cutter{cutter::Shape::flat, 16.0, 4, helix};
    const DelaySystem system =
        delay_system(machine, {cutter, force::slot(depth), force::Coefficients{}}, speed, damping);
    const double added = damping * depth / (8.0 * speed) / mass;  // C b/v N/4, per mass
    // The roots of s^2 + c s + w^2; beyond critical damping both are real.
    const double w = mode.natural_frequency, c = 2.0 * mode.damping_ratio * w + added;
    const double slowest = -0.5 * c + std::sqrt(std::max(0.0, 0.25 * c * c - w * w));
    const double expected = std::exp(slowest * system.period);
    EXPECT_NEAR(floquet(system, {1e-10}).spectral_radius, expected, 1e-9 * expected);
    for (const int order : {0, 1, 2}) {
      EXPECT_NEAR(floquet(system, {1e-3, 40, order}).spectral_radius, expected, 1e-9 * expected);
    }
  }
}

TEST(ProcessDamping, IsTheSameByCollocationAndBySemiDiscretization) {
  double worst = 0.0, most = 0.0;
  for (const RandomCut& cut : damped_cuts(20)) {
    const double depth = 0.1 * cut.largest_depth;
    const double exact = floquet(cut.at(depth), {1e-5}).spectral_radius;
    worst = std::max(
        worst, std::abs(floquet(cut.at(depth), {1e-3, 4000, 2}).spectral_radius / exact - 1.0));
    RandomCut without = cut;
    without.process_damping = 0.0;
    const double rigid = floquet(without.at(depth), {1e-5}).spectral_radius;
    most = std::max(most, std::abs(exact / rigid - 1.0));
  }
  std::cout << "off by " << worst << "; without it up to " << most << "\n";
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(most, 0.3);
}

// There both directional matrices are constant.
TEST(ProcessDamping, LeavesTheZerothOrderExactInASlotWithAnEvenNumberOfTeethFrom4Up) {
  Machine machine;
  machine.x = {{{500.0 * 2.0 * core::kPi, 0.03}, 0.0, 1.0e4}};
  machine.y = {{{620.0 * 2.0 * core::kPi, 0.02}, 0.0, 2.0e4}};
  double worst = 0.0, least = 1e300;
  for (const double rpm : {400.0, 900.0, 2500.0, 7000.0}) {
    const cutter::Cutter cutter{cutter::Shape::flat, 16.0, 4, 0.5};
    const double speed = testing::spindle(rpm);
    const auto zeroth = [&](double damping) {
      return zeroth_order_limit(frequency_domain(machine), cutter, force::Arc{},
                                testing::kInsperger, speed, 100.0, {}, damping)
          .axial_depth_limit;
    };
    const double limit = zeroth(100.0);
    DepthSearch search;
    search.largest_depth = 2.0 * limit;
    search.tolerance = 1e-7;
    const auto system = [&](double depth) {
      return delay_system(machine, {cutter, force::slot(depth), testing::kInsperger}, speed, 100.0);
    };
    worst = std::max(worst, std::abs(depth_limits(system, search).axial_depth_limit / limit - 1.0));
    least = std::min(least, limit / zeroth(0.0));
  }
  std::cout << "off by " << worst << "; times the limit without, least " << least << "\n";
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(least, 1.0);
}

TEST(ProcessDamping, HasTheVerdictsOfTheSimulation) {
  int compared = 0, changed = 0;
  for (const RandomCut& cut : damped_cuts(60)) {
    for (const double share : {0.1, 0.4}) {
      const double depth = share * cut.largest_depth;
      const double radius = floquet(cut.at(depth), {1e-4}).spectral_radius;
      const double per_turn =
          std::log(radius) * 2.0 * core::kPi / (cut.spindle_speed * cut.at(depth).period);
      if (std::abs(per_turn) < 0.05) continue;  // near the boundary
      TimeDomain settings;
      settings.feed_per_tooth = 0.0;
      settings.tool_leaves_cut = false;
      settings.process_damping = cut.process_damping;
      const Simulated found =
          simulate(cut.machine, cut.cutter, {cut.arc.entry_angle, cut.arc.exit_angle, depth},
                   cut.coefficients, cut.spindle_speed, settings);
      EXPECT_EQ(found.stable, radius < 1.0)
          << cut << " at " << depth << " mm: " << per_turn << ", " << found.growth_per_turn;
      RandomCut without = cut;
      without.process_damping = 0.0;
      changed += (radius_at_level(without.at(depth), 4, 1e-6).value < 1.0) != (radius < 1.0);
      ++compared;
    }
  }
  std::cout << compared << " cuts, " << changed << " stable only by process damping\n";
  EXPECT_GT(compared, 90);
  EXPECT_GT(changed, 5);
}

TEST(ProcessDamping, ThatIsNegativeIsRefused) {
  RandomCut cut = damped_cuts(1).front();
  cut.process_damping = -1.0;
  EXPECT_THROW(cut.at(1.0), core::InputError);
}

}  // namespace
}  // namespace millstudy::dynamics
