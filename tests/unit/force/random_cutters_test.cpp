// SPDX-License-Identifier: MIT
// Sampler and force basis against a reference that shares no code with them, for cutters of every
// shape with everything that can vary. Prints the worst distance of each shape and feature.
#include "unit/force/random_cutters.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <map>

#include "force/sampler.h"

namespace millstudy::force {
namespace {

using reference::Cut;
using reference::Load;
using testing::Kind;
using testing::uniform;

constexpr int kAngles = 3;      // compared in each cut
constexpr int kMoreAngles = 5;  // for the peak
constexpr double kTolerance = 1e-9;

/// One sample at an immersion angle of flute 0, in feed axes; it goes through the feed direction.
/// It is sample n, and number `at` of those asked for.
std::array<double, 4> sample_at(const ForceSampler& sampler, const Cut& cut, Rows rows, double phi,
                                int n, int at = 0, int count = 1) {
  Feed feed = cut.feed;
  feed.direction = phi - 2.0 * core::kPi * n / sampler.angular_steps();
  ForceSamples out;
  if (rows == Rows::moments) {
    sampler.sample_moments(cut.coefficients, feed, n - at, count, out);
  } else {
    sampler.sample(cut.coefficients, feed, n - at, count, out);
  }
  for (const auto* row : {&out.x, &out.y, &out.z, &out.torque}) {
    EXPECT_TRUE(std::isfinite((*row)[at])) << phi << " " << cut;
  }
  const double c = std::cos(feed.direction), s = std::sin(feed.direction);
  return {out.x[at] * c + out.y[at] * s, out.y[at] * c - out.x[at] * s, out.z[at], out.torque[at]};
}

/// An angle at which some flute is in cut.
double busy_angle(std::mt19937_64& random, const reference::Tool& tool, const Cut& cut) {
  const int flute = static_cast<int>(random() % tool.flutes());
  const Arc arc = cut.arcs[random() % cut.arcs.size()];
  const double lag = tool.tangent(flute) * tool.lambda(cut.axial_depth * uniform(random, 0.0, 1.0));
  return uniform(random, arc.entry_angle, arc.exit_angle) - tool.position(flute) + lag;
}

/// What of a reference load a sampler gives.
std::array<double, 4> rows_of(const Load& load, Rows rows) {
  if (rows == Rows::moments) return {load[4], load[5], 0.0, 0.0};
  return {load[0], load[1], load[2], load[3]};
}

struct Distances {
  double sampler = 0.0;
  double basis = 0.0;
  bool idle = false;  ///< both find no force at any of the angles
};

Distances distances(const Cut& cut, std::mt19937_64& random) {
  const reference::Tool tool(cut.cutter);
  const double radius = cutter::radius(cut.cutter);
  const Rows rows = random() % 5 == 0 ? Rows::moments : Rows::forces;
  const Arc first = cut.arcs[0];
  const int steps = 1 + static_cast<int>(random() % 40);
  const ForceSampler one(cut.cutter, {first.entry_angle, first.exit_angle, cut.axial_depth}, {},
                         steps, cut.variation, rows == Rows::moments);
  const ForceSampler sampler = cut.arcs.size() == 1 ? one : one.with_arcs(cut.arcs);
  std::vector<double> angles;
  double peak = 0.0;
  for (int i = 0; i < kAngles + kMoreAngles; ++i) {
    angles.push_back(busy_angle(random, tool, cut));
    const auto force = sample_at(sampler, cut, rows, angles.back(), 0);
    peak = std::max(peak, testing::distance(force, {}, radius));
  }
  const double scale = rows == Rows::moments ? radius + cut.axial_depth : 1.0;
  Distances worst;
  double force_peak = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    const Load load = reference::load(tool, cut, angles[i], 1e-12 * peak / scale + 1e-18);
    const auto expected = rows_of(load, rows);
    peak = std::max(peak, testing::distance(expected, {}, radius));
    force_peak = std::max(force_peak, testing::distance(rows_of(load, Rows::forces), {}, radius));
    const int n = static_cast<int>(random() % steps);
    const int count = 1 + static_cast<int>(random() % 24);
    const int at = static_cast<int>(random() % count);
    worst.sampler = std::max(
        worst.sampler, testing::distance(sample_at(sampler, cut, rows, angles[i], n, at, count),
                                         expected, radius));
    if (cut.variation.with_chip() || !reference::always_has_chip(tool, cut)) continue;
    std::array<double, 4> basis{};
    for (const Arc& arc : cut.arcs) {
      const auto part =
          evaluate(force_basis(cut.cutter, {arc.entry_angle, arc.exit_angle, cut.axial_depth}, {},
                               angles[i], cut.variation),
                   cut.coefficients, cut.feed);
      for (int row = 0; row < 4; ++row) basis[row] += part[row];
    }
    worst.basis =
        std::max(worst.basis, testing::distance(basis, rows_of(load, Rows::forces), radius));
  }
  worst.idle = peak == 0.0;
  if (peak > 0.0) worst.sampler /= peak;
  const double both = std::max(force_peak, rows == Rows::forces ? peak : 0.0);
  if (both > 0.0) worst.basis /= both;
  return worst;
}

/// Of each of eight shapes; MILLSTUDY_RANDOM_FACTOR multiplies it for a long run.
int cuts() {
  const char* factor = std::getenv("MILLSTUDY_RANDOM_FACTOR");
  return 250 * (factor ? std::max(1, std::atoi(factor)) : 1);
}

class RandomCutter : public ::testing::TestWithParam<Kind> {};

TEST_P(RandomCutter, ForceAgreesWithAnIndependentIntegral) {
  const int count = cuts();
  std::map<std::string, double> worst;
  double basis = 0.0;
  int idle = 0;
  for (int i = 0; i < count; ++i) {
    std::mt19937_64 random(1000000 * (1 + static_cast<int>(GetParam())) + i);
    const Cut cut = testing::random_cut(random, GetParam());
    const Distances found = distances(cut, random);
    EXPECT_LT(found.sampler, kTolerance) << i << " " << testing::features(cut) << ": " << cut;
    EXPECT_LT(found.basis, kTolerance) << i << " basis: " << cut;
    double& so_far = worst[testing::features(cut)];
    so_far = std::max(so_far, found.sampler);
    basis = std::max(basis, found.basis);
    idle += found.idle;
  }
  std::cout << testing::name(GetParam()) << ", " << count << " cuts, " << idle << " idle: basis "
            << basis << " of the peak; sampler:\n";
  EXPECT_LT(10 * idle, count);
  for (const auto& [features, distance] : worst) {
    std::cout << "  " << features << ": " << distance << '\n';
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryShape, RandomCutter,
                         ::testing::Values(Kind::flat, Kind::ball, Kind::tapered_ball,
                                           Kind::bull_nose, Kind::taper, Kind::general,
                                           Kind::general_centred, Kind::profile),
                         [](const auto& of) {
                           std::string text = testing::name(of.param);
                           std::erase_if(text, [](char c) {
                             return !std::isalpha(static_cast<unsigned char>(c));
                           });
                           return text;
                         });

}  // namespace
}  // namespace millstudy::force
