// SPDX-License-Identifier: MIT
#include "force/sampler.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <iostream>
#include <random>
#include <thread>

#include "core/error.h"
#include "unit/force/cases.h"

namespace millstudy::force {
namespace {

using testing::Case;
using testing::distance;
using testing::Force;
using testing::random_case;
using testing::uniform;

Force sample_at(const ForceSamples& samples, std::size_t i) {
  return {samples.x[i], samples.y[i], samples.z[i], samples.torque[i]};
}

/// The reference kernel in a feed frame turned by theta, back in machine axes.
Force turned_force(const Case& c, const EdgeRule& rule, double spindle_angle, double theta) {
  const ForceBasis basis = force_basis(c.cutter, c.engagement, rule, spindle_angle + theta);
  const Force f = evaluate(basis, c.coefficients, {c.feed_per_tooth});
  return {f[0] * std::cos(theta) - f[1] * std::sin(theta),
          f[0] * std::sin(theta) + f[1] * std::cos(theta), f[2], f[3]};
}

/// Largest disagreement of a sampler with the reference kernel, relative to the peak.
///
/// Both round the immersion angle, by a few 1e-16 rad a step. Where the edge sweeps a limit within
/// a short lag the force itself changes by that over the lag, so what 4e-15 rad do to the
/// reference is not counted.
double disagreement(const Case& c, const EdgeRule& rule, int steps, double theta) {
  ForceSamples samples;
  ForceSampler(c.cutter, c.engagement, rule, steps)
      .sample(c.coefficients, {c.feed_per_tooth, theta}, 0, steps, samples);
  const double radius = cutter::radius(c.cutter);
  double peak = 0.0;
  double worst = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2.0 * core::kPi * i / steps;
    const Force reference = turned_force(c, rule, angle, theta);
    const double rounding = distance(turned_force(c, rule, angle - 4e-15, theta),
                                     turned_force(c, rule, angle + 4e-15, theta), radius);
    peak = std::max(peak, distance(reference, Force{}, radius));
    worst = std::max(worst, distance(sample_at(samples, i), reference, radius) - rounding);
  }
  return peak > 0.0 ? worst / peak : worst;
}

double worst_disagreement(cutter::Shape shape, const EdgeRule& rule, int cases, bool turn,
                          double tolerance) {
  std::mt19937_64 random(20261123);
  double worst = 0.0;
  for (int i = 0; i < cases; ++i) {
    const Case c = random_case(random, shape);
    const double theta = turn ? uniform(random, -10.0, 10.0) : 0.0;
    const int steps = 1 + static_cast<int>(random() % 180);
    const double found = disagreement(c, rule, steps, theta);
    EXPECT_LT(found, tolerance) << c << " steps=" << steps << " theta=" << theta;
    worst = std::max(worst, found);
  }
  std::cout << "sampler against reference kernel, " << cases << " cases: " << worst
            << " of the peak\n";
  return worst;
}

TEST(ForceSampler, AgreesWithTheReferenceKernelForFlat) {
  worst_disagreement(cutter::Shape::flat, {}, 400, false, 1e-13);
}

TEST(ForceSampler, AgreesWithTheRotatedReferenceKernelInATurnedFeedFrame) {
  worst_disagreement(cutter::Shape::flat, {}, 400, true, 1e-13);
  worst_disagreement(cutter::Shape::ball, {}, 100, true, 1e-12);
}

TEST(ForceSampler, AgreesWithTheReferenceKernelForBall) {
  worst_disagreement(cutter::Shape::ball, {}, 100, false, 1e-12);
}

TEST(ForceSampler, AgreesWithTheReferenceKernelForBallsOfEveryHelix) {
  for (const double helix_deg : {-80.0, -60.0, -1.0, 0.0, 1e-8, 15.0, 45.0, 70.0, 80.0}) {
    double worst = 0.0;
    for (const double depth : {0.01, 0.5, 5.0, 6.0, 11.0}) {
      const cutter::Cutter cutter{cutter::Shape::ball, 12.0, 3, core::rad_from_deg(helix_deg)};
      for (const Engagement& engagement : {slot(depth), up_milling(6.0, 0.01, depth)}) {
        const Case c{cutter, engagement, 0.06, testing::kGgg70};
        worst = std::max(worst, disagreement(c, {}, 250, 0.4));
      }
    }
    EXPECT_LT(worst, 1e-12) << helix_deg;
    std::cout << "ball, helix " << helix_deg << " deg: " << worst << " of the peak\n";
  }
}

TEST(ForceSampler, AgreesWithTheReferenceKernelForDiscs) {
  worst_disagreement(cutter::Shape::flat, {Rule::discs, 37}, 100, true, 1e-13);
  worst_disagreement(cutter::Shape::ball, {Rule::discs, 37}, 100, true, 1e-13);
}

/// Zero helix at round angles: a tooth enters or leaves exactly at a sample.
TEST(ForceSampler, CountsOneToothOfTwoInASlotWithoutHelix) {
  for (const double hand : {1.0, -1.0}) {
    for (const Rule rule : {Rule::exact, Rule::discs}) {
      for (const int steps : {2, 7, 36, 360, 720, 3600}) {
        const cutter::Cutter cutter{cutter::Shape::flat, 12.0, 2, hand * 1e-300};
        ForceSamples samples;
        ForceSampler(cutter, slot(1.0), {rule, 10}, steps)
            .sample({0.0, 0.0, 0.0, 0.0, 0.0, 1.0}, {0.1}, 0, steps, samples);
        for (int i = 0; i < steps; ++i) {
          EXPECT_NEAR(samples.z[i], -1.0, 1e-14) << i << " of " << steps;
          const ForceBasis basis =
              force_basis(cutter, slot(1.0), {rule, 10}, 2.0 * core::kPi * i / steps);
          EXPECT_NEAR(basis.edge[2][2], -1.0, 1e-14) << i << " of " << steps;
        }
      }
    }
  }
}

bool same_bits(const ForceSamples& a, std::size_t at_a, const ForceSamples& b, std::size_t at_b,
               std::size_t count) {
  const auto same = [&](const std::vector<double>& u, const std::vector<double>& v) {
    return std::memcmp(u.data() + at_a, v.data() + at_b, count * sizeof(double)) == 0;
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.torque, b.torque);
}

TEST(ForceSampler, SamplesInPiecesAreThoseAtOnceBitForBit) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 200; ++round) {
    const auto shape = round % 2 ? cutter::Shape::ball : cutter::Shape::flat;
    const Case c = random_case(random, shape);
    const EdgeRule rule{round % 5 ? Rule::exact : Rule::discs, 9};
    const int steps = 1 + static_cast<int>(random() % 400);
    const ForceSampler sampler(c.cutter, c.engagement, rule, steps);
    const std::int64_t first = static_cast<std::int64_t>(random() % 2000) - 1000;
    const std::int64_t count = 1 + static_cast<std::int64_t>(random() % 900);
    ForceSamples whole, piece;
    sampler.sample(c.coefficients, {c.feed_per_tooth, 0.7}, first, count, whole);
    for (std::int64_t done = 0; done < count;) {
      const std::int64_t part = std::min<std::int64_t>(count - done, random() % 60);
      sampler.sample(c.coefficients, {c.feed_per_tooth, 0.7}, first + done, part, piece);
      ASSERT_TRUE(same_bits(whole, done, piece, 0, part)) << c << " at " << done;
      done += part;
    }
  }
}

TEST(ForceSampler, LosesNothingAsTheSpindleAngleRunsOn) {
  const cutter::Cutter cutter = testing::haber_cutter(cutter::Shape::flat);
  const ForceSampler sampler(cutter, slot(0.5), {}, 360);
  ForceSamples near, far;
  sampler.sample(testing::kGgg70, {0.06, 0.3}, 5, 360, near);
  sampler.sample(testing::kGgg70, {0.06, 0.3}, 5 + 360 * std::int64_t{1'000'000'000'000}, 360, far);
  EXPECT_TRUE(same_bits(near, 0, far, 0, 360));
}

TEST(ForceSampler, GivesTheSameBitsOnEveryThread) {
  std::mt19937_64 random(11);
  const Case c = random_case(random, cutter::Shape::ball);
  const ForceSampler sampler(c.cutter, c.engagement, {}, 720);
  std::vector<ForceSamples> results(4);
  std::vector<std::thread> threads;
  for (ForceSamples& result : results) {
    threads.emplace_back([&] {
      sampler.sample(c.coefficients, {c.feed_per_tooth, 1.1}, 3, 2000, result);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const ForceSamples& result : results) {
    EXPECT_TRUE(same_bits(results[0], 0, result, 0, 2000));
  }
}

TEST(ForceSampler, RefusesAngularStepsOutOfRange) {
  const cutter::Cutter cutter;
  EXPECT_THROW(ForceSampler(cutter, slot(1.0), {}, 0), core::InputError);
  EXPECT_THROW(ForceSampler(cutter, slot(1.0), {}, 100'000'000), core::InputError);
  EXPECT_THROW(ForceSampler(cutter, slot(0.0), {}, 360), core::InputError);
  EXPECT_THROW(ForceSampler(cutter, slot(1.0), {Rule::discs, 0}, 360), core::InputError);
}

}  // namespace
}  // namespace millstudy::force
