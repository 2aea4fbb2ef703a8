// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "core/error.h"
#include "force/chip_thickness.h"
#include "paths.h"
#include "process/machine_along.h"

namespace millstudy::process {
namespace {

using Side = Immersion::Side;
using testing::circle;
using testing::straight;

const force::Coefficients kGgg70{2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};
constexpr double kRadius = 6.0;

cutter::Cutter cutter_of(cutter::Shape shape) {
  return {shape, 2.0 * kRadius, 2, core::rad_from_deg(30.0)};
}

struct Bench {
  explicit Bench(const force::Engagement& engagement, cutter::Shape shape = cutter::Shape::flat)
      : machining{cutter_of(shape), engagement, kGgg70, 14500.0 / 60.0, 360},
        sampler(machining.cutter, engagement, {}, 360) {}

  PathForces along(const path::Interpolation& path, const SampleObserver& observer = {}) const {
    return machine_along(path, sampler, machining, observer);
  }

  Machining machining;
  force::ForceSampler sampler;
};

bool equal(const force::Statistics& a, const force::Statistics& b) {
  return a.mean == b.mean && a.min == b.min && a.max == b.max && a.rms == b.rms;
}

bool equal(const PathForces& a, const PathForces& b) {
  return equal(a.figures.statistics.x, b.figures.statistics.x) &&
         equal(a.figures.statistics.y, b.figures.statistics.y) &&
         equal(a.figures.statistics.z, b.figures.statistics.z) &&
         equal(a.figures.statistics.resultant, b.figures.statistics.resultant) &&
         a.figures.statistics.torque_mean == b.figures.statistics.torque_mean &&
         a.figures.statistics.torque_max == b.figures.statistics.torque_max &&
         a.figures.chip_thickness_max == b.figures.chip_thickness_max;
}

TEST(VaryingCut, OnAStraightPathIsTheConstantOneToTheBit) {
  const path::Interpolation path = straight(360, 0.058, 0.7);
  for (const Side side : {Side::up, Side::down}) {
    Bench bench(side == Side::up ? force::up_milling(kRadius, 2.0, 0.5)
                                 : force::down_milling(kRadius, 2.0, 0.5));
    const PathForces constant = bench.along(path);
    bench.machining.immersion = {side, 2.0};
    EXPECT_TRUE(equal(bench.along(path), constant));
  }
}

TEST(VaryingCut, OnACircleIsTheConstantOneOfItsOwnAngles) {
  for (const double curvature : {0.05, -0.05}) {
    const path::Interpolation path = circle(500, 0.058, curvature, 0.3);
    Bench bench(force::up_milling(kRadius, 2.0, 0.5));
    bench.machining.immersion = {Side::up, 2.0};
    const Bench own(force::up_milling(kRadius, 2.0 * (1.0 - curvature * 5.0), 0.5));
    const PathForces curved = bench.along(path), constant = own.along(path);
    EXPECT_NEAR(curved.figures.statistics.x.mean, constant.figures.statistics.x.mean, 1e-6);
    EXPECT_NEAR(curved.figures.statistics.resultant.rms, constant.figures.statistics.resultant.rms,
                1e-6);
    EXPECT_NEAR(curved.figures.statistics.resultant.max, constant.figures.statistics.resultant.max,
                1e-6);
    EXPECT_NEAR(curved.figures.chip_thickness_max, constant.figures.chip_thickness_max, 1e-9);
  }
}

TEST(VaryingCut, IsAirOutsideTheStock) {
  Bench bench(force::slot(0.5));
  bench.machining.stock = Stock::both;
  const path::Interpolation path = straight(400, 0.058, 0.0);
  std::vector<double> torque;  // mean over the period
  const auto keep_mean = [&](std::int64_t, std::int64_t count, const force::ForceSamples& f) {
    torque.push_back(std::accumulate(f.torque.begin(), f.torque.begin() + count, 0.0) /
                     static_cast<double>(count));
  };
  const PathForces cut = bench.along(path, keep_mean);
  bench.machining.stock = Stock::endless;
  const PathForces endless = bench.along(path);
  EXPECT_EQ(cut.samples, endless.samples);
  ASSERT_EQ(torque.size(), 400U);
  EXPECT_LT(torque.front(), 0.2 * torque[200]);
  EXPECT_LT(torque.back(), 0.1 * torque[200]);
  EXPECT_LT(cut.figures.statistics.torque_mean, 0.95 * endless.figures.statistics.torque_mean);
  EXPECT_EQ(cut.figures.statistics.torque_max, endless.figures.statistics.torque_max);
}

TEST(VaryingCut, RemovesTheVolumeOfTheStock) {
  // With Ktc = 1 N/mm2 and nothing else the work is the volume. The slot is cut from one radius
  // ahead of the start to the end, where the widest part of the tool leaves the stock.
  Bench bench(force::slot(0.5));
  bench.machining.coefficients = {1.0};
  bench.machining.stock = Stock::both;
  const path::Interpolation path = straight(1000, 0.03, 0.0);
  const PathForces cut = bench.along(path);
  const double duration = 1000 * 0.002;
  const double work = cut.figures.statistics.torque_mean * 2.0 * core::kPi *
                      bench.machining.spindle_speed * duration;
  const double length = 30.0 - kRadius;
  EXPECT_NEAR(work, 0.5 * 12.0 * length, 3e-4 * work);
  EXPECT_NEAR(cut.removal_rate * duration, work, 3e-4 * work);  // (M12)
}

TEST(VaryingCut, ConvergesWithThePeriodAtTheEndsOfTheStock) {
  // The same feed rate and spindle, at a period of 2, 1, 0.5 and 0.06 ms.
  std::vector<PathForces> results;
  for (const int halvings : {0, 1, 2, 5}) {
    Bench bench(force::up_milling(kRadius, 2.0, 0.5));
    bench.machining.immersion = {Side::up, 2.0};
    bench.machining.stock = Stock::both;
    path::Interpolation path = circle(500 << halvings, 0.058 / (1 << halvings), 0.03, 0.3);
    path.period = 0.002 / (1 << halvings);
    results.push_back(bench.along(path));
  }
  const force::ForceStatistics& exact = results.back().figures.statistics;
  const auto error = [&](int i) {
    return std::abs(results[i].figures.statistics.x.mean / exact.x.mean - 1.0);
  };
  EXPECT_LT(error(0), 5e-4);
  EXPECT_LT(error(1), 0.8 * error(0));
  EXPECT_LT(error(2), 0.4 * error(0));
  EXPECT_NEAR(results[0].figures.statistics.resultant.rms, exact.resultant.rms,
              3e-4 * exact.resultant.rms);
  EXPECT_NEAR(results[0].figures.statistics.resultant.max, exact.resultant.max,
              1e-4 * exact.resultant.max);
}

TEST(Slope, OfAStraightRampIsThatOfTheFeed) {
  for (const auto shape : {cutter::Shape::flat, cutter::Shape::ball}) {
    for (const double slope : {0.2, -0.2}) {
      const Bench bench(force::slot(0.5), shape);
      path::Interpolation path;
      path.period = 0.002;
      for (int i = 0; i <= 360; ++i) {
        path.points.push_back(
            {i * 0.058 * std::cos(slope), 0.0, 3.0 + i * 0.058 * std::sin(slope)});
      }
      const PathForces along = bench.along(path);
      force::ForceSamples samples;
      bench.sampler.sample(kGgg70, {0.06, 0.0, slope}, 0, 360, samples);
      force::StatisticsAccumulator revolution;
      revolution.add(samples, 360);
      const force::ForceStatistics plain = revolution.result();
      EXPECT_NEAR(along.figures.statistics.x.mean, plain.x.mean, 1e-9);
      EXPECT_NEAR(along.figures.statistics.z.mean, plain.z.mean, 1e-9);
      EXPECT_NEAR(along.figures.statistics.resultant.max, plain.resultant.max, 1e-9);
    }
  }
}

TEST(Slope, IsTakenUpTo15Degrees) {
  const Bench bench(force::slot(0.5));
  const auto ramp = [](double slope) {
    path::Interpolation path = straight(50, 0.058 * std::cos(slope), 0.3);
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      path.points[i].z = 100.0 + static_cast<double>(i) * 0.058 * std::sin(slope);
    }
    return path;
  };
  const double limit = core::rad_from_deg(15.0);
  EXPECT_NO_THROW(bench.along(ramp(limit)));
  EXPECT_NO_THROW(bench.along(ramp(-limit)));
  EXPECT_THROW(bench.along(ramp(limit + 1e-6)), core::CaseError);
  EXPECT_THROW(bench.along(ramp(-limit - 1e-6)), core::CaseError);
  EXPECT_THROW(bench.along(ramp(0.5 * core::kPi)), core::CaseError);
  EXPECT_THROW(bench.along(testing::path_of({{0, 0, 1}, {0, 0, 0}, {1, 0, 0}})), core::CaseError);
}

TEST(Slope, OfAPathAtAnyHeightIsNone) {
  const Bench bench(force::slot(0.5), cutter::Shape::ball);
  path::Interpolation raised = straight(100, 0.058, 0.3);
  const PathForces low = bench.along(raised);
  for (path::Vec3& point : raised.points) point.z = -71.3;
  raised.points[50].z += 5e-14;  // as rounding may
  EXPECT_TRUE(equal(bench.along(raised), low));
}

TEST(Slope, DoesNotMindARest) {
  const Bench bench(force::slot(0.5));
  path::Interpolation path = straight(100, 0.058, 0.3);
  path.points.insert(path.points.begin() + 40, 3, path.points[40]);
  const PathForces along = bench.along(path);
  EXPECT_TRUE(std::isfinite(along.figures.statistics.x.mean));
  EXPECT_TRUE(std::isfinite(along.figures.chip_thickness_max));
}

/// The chip over all immersion angles and heights, by looking.
double thickest_by_scan(const cutter::Cutter& cutter, const force::Arc& arc, double depth,
                        const force::Feed& feed) {
  double thickest = 0.0;
  for (int i = 0; i <= 400; ++i) {
    const double phi = arc.entry_angle + (arc.exit_angle - arc.entry_angle) * i / 400;
    for (int j = 0; j <= 400; ++j) {
      const double part = j / 400.0;
      const double kappa = cutter::envelope(cutter, depth * part * part).kappa;
      thickest = std::max(thickest, feed.in_plane() * std::sin(phi) * std::sin(kappa) -
                                        feed.upward() * std::cos(kappa));
    }
  }
  return thickest;
}

TEST(ThickestChip, OnASlopeIsWhereAScanFindsIt) {
  for (const auto shape : {cutter::Shape::flat, cutter::Shape::ball}) {
    for (const double slope : {-0.25, -0.05, 0.1, 0.25}) {
      for (const double depth : {0.05, 1.0, 7.0}) {
        for (const force::Arc arc : {force::Arc{0.0, 0.9}, {0.2, 2.0}, {2.0, core::kPi}}) {
          const force::Feed feed{0.06, 0.0, slope};
          const double thickest =
              force::largest_chip_thickness(force::CuttingEdges(cutter_of(shape), depth, {}),
                                            force::largest_sine(std::span(&arc, 1)), feed)
                  .front();
          const double scan = thickest_by_scan(cutter_of(shape), arc, depth, feed);
          EXPECT_GE(thickest, scan - 1e-15);
          EXPECT_LT(thickest, scan + 1e-4 * 0.06);
        }
      }
    }
  }
}

}  // namespace
}  // namespace millstudy::process
