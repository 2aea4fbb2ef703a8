// SPDX-License-Identifier: MIT
// Cuts simulated in time against their multipliers. MILLSTUDY_RANDOM_CUTS asks for more of them.
#include "dynamics/time_domain.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

#include "dynamics/depth_limit.h"
#include "dynamics/floquet.h"
#include "unit/dynamics/insperger.h"
#include "unit/dynamics/random_cut.h"

namespace millstudy::dynamics {
namespace {

using testing::RandomCut;

int cuts(int fewest) {
  const char* more = std::getenv("MILLSTUDY_RANDOM_CUTS");
  return more ? std::max(fewest, std::atoi(more)) : fewest;
}

/// Log of the spectral radius, over one turn.
double growth(const RandomCut& cut, double depth) {
  const DelaySystem system = cut.at(depth);
  const double turns = system.period * cut.spindle_speed / (2.0 * core::kPi);
  return std::log(floquet(system, {1e-4}).spectral_radius) / turns;
}

Simulated simulated(const RandomCut& cut, double depth, const TimeDomain& settings) {
  return simulate(cut.machine, cut.cutter, {cut.arc.entry_angle, cut.arc.exit_angle, depth},
                  cut.coefficients, cut.spindle_speed, settings);
}

TEST(TimeDomain, GivesTheVerdictOfTheMultipliersForRandomCutters) {
  const int count = cuts(40);
  int agree = 0, near = 0, stable = 0;
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    std::mt19937_64 random(1000 + i);
    const RandomCut cut = testing::random_cut(random);
    DepthSearch search;
    search.largest_depth = cut.largest_depth;
    const double limit =
        depth_limits([&](double depth) { return cut.at(depth); }, search).axial_depth_limit;
    const double share =
        std::exp(std::log(2.0) * (2.0 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1.0));
    const double depth = std::min(limit * share, cut.largest_depth);
    TimeDomain settings;
    settings.feed_per_tooth = 0.0;
    settings.tool_leaves_cut = false;
    const double expected = growth(cut, depth);
    const Simulated found = simulated(cut, depth, settings);
    stable += found.stable;
    worst = std::max(worst, std::abs(found.growth_per_turn - expected));
    if (found.stable == (expected < 0.0)) {
      ++agree;
      continue;
    }
    const bool at_boundary = (growth(cut, 0.98 * depth) < 0.0) != (growth(cut, 1.02 * depth) < 0.0);
    near += at_boundary;
    EXPECT_TRUE(at_boundary) << "seed " << 1000 + i << " depth " << depth << " growth " << expected
                             << " simulated " << found.growth_per_turn << ": " << cut;
  }
  std::cout << agree << " of " << count << " agree, " << near
            << " differ within 2 % of the boundary, " << stable
            << " stable; growth per turn off by " << worst << "\n";
}

}  // namespace
}  // namespace millstudy::dynamics
