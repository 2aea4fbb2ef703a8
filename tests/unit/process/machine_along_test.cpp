// SPDX-License-Identifier: MIT
#include "process/machine_along.h"

#include <cmath>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"
#include "paths.h"

namespace millstudy::process {
namespace {

using testing::straight;

const cutter::Cutter kCutter{cutter::Shape::flat, 12.0, 2, core::rad_from_deg(30.0)};
const force::Coefficients kGgg70{2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};

struct Bench {
  force::Engagement engagement = force::slot(0.5);
  Machining machining{kCutter, engagement, kGgg70, 14500.0 / 60.0, 360};
  force::ForceSampler sampler{kCutter, engagement, {}, 360};
};

TEST(MachineAlong, OnAStraightPathIsThePlainForce) {
  const Bench bench;
  // 174 samples a period: 360 periods are 174 whole revolutions. 29 mm/s is 0.06 mm per tooth.
  const PathForces along = machine_along(straight(360, 0.058, 0.0), bench.sampler, bench.machining);
  force::ForceSamples samples;
  bench.sampler.sample(kGgg70, {0.06}, 0, 360, samples);
  force::StatisticsAccumulator revolution;
  revolution.add(samples, 360);
  const force::ForceStatistics plain = revolution.result();
  EXPECT_EQ(along.samples, 360 * 174);
  EXPECT_NEAR(along.figures.statistics.x.mean, plain.x.mean, 1e-11);
  EXPECT_NEAR(along.figures.statistics.resultant.mean, plain.resultant.mean, 1e-11);
  EXPECT_NEAR(along.figures.statistics.resultant.max, plain.resultant.max, 1e-11);
  EXPECT_NEAR(along.figures.statistics.z.rms, plain.z.rms, 1e-11);
  EXPECT_NEAR(along.figures.statistics.torque_mean, plain.torque_mean, 1e-10);
  EXPECT_NEAR(along.figures.chip_thickness_max, 0.06, 1e-14);
}

TEST(MachineAlong, TurnsWithThePath) {
  const Bench bench;
  const PathForces plain = machine_along(straight(360, 0.058, 0.0), bench.sampler, bench.machining);
  // A quarter turn is 90 of the 360 angular steps: the same samples in another order.
  const PathForces turned =
      machine_along(straight(360, 0.058, core::kPi / 2), bench.sampler, bench.machining);
  EXPECT_NEAR(turned.figures.statistics.y.mean, plain.figures.statistics.x.mean, 1e-10);
  EXPECT_NEAR(turned.figures.statistics.x.mean, -plain.figures.statistics.y.mean, 1e-10);
  EXPECT_NEAR(turned.figures.statistics.x.min, -plain.figures.statistics.y.max, 1e-10);
  EXPECT_NEAR(turned.figures.statistics.resultant.rms, plain.figures.statistics.resultant.rms,
              1e-10);
  EXPECT_NEAR(turned.figures.statistics.torque_max, plain.figures.statistics.torque_max, 1e-10);
}

TEST(MachineAlong, TakesEverySampleOnce) {
  Bench bench;
  for (const double rpm : {14500.0, 17500.0, 9999.0, 137.0}) {
    bench.machining.spindle_speed = rpm / 60.0;
    std::int64_t next = 0;
    const PathForces along =
        machine_along(straight(500, 0.058, 0.3), bench.sampler, bench.machining,
                      [&](std::int64_t first, std::int64_t count, const force::ForceSamples&) {
                        EXPECT_EQ(first, next);
                        next += count;
                      });
    EXPECT_EQ(along.samples, next);
    EXPECT_NEAR(static_cast<double>(next), 500 * 0.002 * rpm / 60.0 * 360.0, 1.0);
  }
}

TEST(MachineAlong, PutsASampleOnTheBoundaryIntoTheLaterPeriod) {
  const double samples_per_period = 0.002 * (14500.0 / 60.0) * 360.0;  // 174 to rounding
  for (std::int64_t i = 0; i < 100'000; ++i) {
    ASSERT_EQ(first_sample_of_period(i, samples_per_period), 174 * i);
  }
}

TEST(MachineAlong, ShowsTheFluctuationOfTheInterpolator) {
  const Bench bench;
  path::Interpolation uneven = straight(360, 0.058, 0.0);
  for (std::size_t i = 1; i < uneven.points.size(); i += 2) uneven.points[i].x += 0.0058;
  const PathForces plain = machine_along(straight(360, 0.058, 0.0), bench.sampler, bench.machining);
  const PathForces shaken = machine_along(uneven, bench.sampler, bench.machining);
  EXPECT_NEAR(shaken.figures.chip_thickness_max, 1.1 * plain.figures.chip_thickness_max, 1e-12);
  EXPECT_GT(shaken.figures.statistics.resultant.max, 1.05 * plain.figures.statistics.resultant.max);
}

TEST(MachineAlong, RefusesMoreSamplesThanAnybodyCanWaitFor) {
  Bench bench;
  bench.machining.angular_steps = 50'000;
  const force::ForceSampler sampler(kCutter, bench.engagement, {}, bench.machining.angular_steps);
  EXPECT_THROW(machine_along(straight(50'000, 0.058, 0.0), sampler, bench.machining),
               core::CaseError);
}

}  // namespace
}  // namespace millstudy::process
