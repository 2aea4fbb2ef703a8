// SPDX-License-Identifier: MIT
#include "force/figures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numeric>
#include <random>

#include "core/error.h"
#include "force/chip_law.h"
#include "force/chip_thickness.h"
#include "unit/force/cases.h"

namespace millstudy::force {
namespace {

using testing::haber_cutter;
using testing::kGgg70;
using testing::uniform;

double thickest(const cutter::Cutter& cutter, const Engagement& engagement, const Feed& feed) {
  const Arc arc = engagement.arc();
  const std::vector<double> all = largest_chip_thickness(
      CuttingEdges(cutter, engagement.axial_depth, {}), largest_sine(std::span(&arc, 1)), feed);
  return *std::max_element(all.begin(), all.end());
}

TEST(ChipThickness, IsLargestInTheMiddleOfTheCutAndAtTheTopOfTheBall) {
  const cutter::Cutter flat = haber_cutter(cutter::Shape::flat);
  const cutter::Cutter ball = haber_cutter(cutter::Shape::ball);
  EXPECT_DOUBLE_EQ(thickest(flat, slot(1.0), {0.1}), 0.1);
  EXPECT_DOUBLE_EQ(thickest(flat, {0.0, 0.5, 1.0}, {0.1}), 0.1 * std::sin(0.5));
  EXPECT_DOUBLE_EQ(thickest(flat, {2.0, 2.5, 1.0}, {0.1}), 0.1 * std::sin(2.0));
  // 1 mm up a ball of 6 mm radius: r = sqrt(1 * 11).
  EXPECT_DOUBLE_EQ(thickest(ball, slot(1.0), {0.1}), 0.1 * std::sqrt(11.0) / 6.0);
  EXPECT_DOUBLE_EQ(thickest(ball, slot(7.0), {0.1}), 0.1);
}

/// A random cutter of unequal flutes with runout.
cutter::Cutter uneven_cutter(std::mt19937_64& random) {
  cutter::Cutter cutter{.shape = random() % 2 ? cutter::Shape::bull_nose : cutter::Shape::flat,
                        .diameter = 10.0,
                        .flutes = 2 + static_cast<int>(random() % 4),
                        .helix_angle = uniform(random, -0.7, 0.7),
                        .corner_radius = 2.0};
  cutter.runout = {uniform(random, 0.0, 0.05), uniform(random, 0.0, 6.0),
                   uniform(random, 0.0, 0.001), uniform(random, 0.0, 6.0)};
  return cutter;
}

TEST(ChipThickness, IsThatOfADenseSearchWithRunout) {
  std::mt19937_64 random(8);
  double worst = 0.0;
  for (int round = 0; round < 50; ++round) {
    const cutter::Cutter cutter = uneven_cutter(random);
    const CuttingEdges edges(cutter, 6.0, {});
    const Arc arc = {uniform(random, 0.0, 1.0), uniform(random, 1.1, 3.1)};
    const Feed feed = {uniform(random, 0.02, 0.1), 0.0, uniform(random, -0.1, 0.1)};
    const std::vector<double> found =
        largest_chip_thickness(edges, largest_sine(std::span(&arc, 1)), feed);
    const ChipLaw law(edges);
    std::vector<Reach> reaches(law.reaches());
    for (int flute = 0; flute < cutter.flutes; ++flute) {
      double searched = 0.0;
      for (const EdgePiece& piece : edges.pieces()) {
        for (int i = 0; i <= 400; ++i) {
          const double z = piece.bottom + (piece.top - piece.bottom) * i / 400;
          const double kappa = piece.segment.kappa_at(z);
          law.find(flute, edge_point(edges.envelope(), edges.flutes()[flute].helix_tangent, z),
                   reaches);
          for (int n = 0; n <= 60; ++n) {
            const double phi = arc.entry_angle + (arc.exit_angle - arc.entry_angle) * n / 60;
            searched = std::max(searched, ChipLaw::thickness(reaches, feed, std::sin(phi),
                                                             std::sin(kappa), std::cos(kappa)));
          }
        }
      }
      EXPECT_GE(found[flute], searched * (1.0 - 1e-7));
      EXPECT_LE(found[flute], searched + 1e-3 * feed.per_tooth);
      if (searched > 0.0) worst = std::max(worst, 1.0 - found[flute] / searched);
    }
  }
  std::cout << "thickest chip below a dense search by at most " << worst << " of itself\n";
}

TEST(Figures, TheThickestChipIsOfThePieceThatCutsIt) {
  const ForceSampler sampler(haber_cutter(cutter::Shape::flat), slot(0.5), {}, 36);
  const Arc shallow = {0.0, 0.1}, whole = {0.0, 2.0};
  FigureAccumulator figures({}, sampler);
  ForceSamples samples;
  const auto add = [&](std::span<const Arc> arcs, double feed) {
    const ForceSampler engaged = sampler.with_arcs(arcs);
    engaged.sample(kGgg70, {feed}, 0, 36, samples);
    figures.add(engaged, kGgg70, {feed}, 0, 36, samples);
  };
  add({}, 0.9);
  EXPECT_EQ(figures.result().chip_thickness_max, 0.0);
  add(std::span(&shallow, 1), 0.5);
  EXPECT_NEAR(figures.result().chip_thickness_max, 0.5 * std::sin(0.1), 1e-15);
  add(std::span(&whole, 1), 0.06);
  EXPECT_NEAR(figures.result().chip_thickness_max, 0.06, 1e-15);
}

TEST(Spectrum, IsTheFourierSeriesOfACosine) {
  constexpr int kSteps = 360, kFlutes = 3;
  ForceSamples samples;
  samples.resize(kSteps);
  for (int s = 0; s < kSteps; ++s) {
    const double phi = 2.0 * core::kPi * s / kSteps;
    samples.x[s] = 5.0 + 2.0 * std::cos(3.0 * phi - 0.4) + 0.5 * std::sin(9.0 * phi);
    samples.y[s] = 7.0 * std::cos(180.0 * phi);
    samples.z[s] = std::cos(2.0 * phi);  // not of the tooth passing
    samples.torque[s] = 0.0;
  }
  Spectrum spectrum(60, kFlutes, kSteps);
  spectrum.add(samples, 0, kSteps);
  const auto amplitudes = spectrum.amplitudes();
  EXPECT_NEAR(amplitudes[0][0], 2.0, 1e-13);
  EXPECT_NEAR(amplitudes[0][1], 0.0, 1e-13);
  EXPECT_NEAR(amplitudes[0][2], 0.5, 1e-13);
  EXPECT_NEAR(amplitudes[1][59], 7.0, 1e-11);
  for (const double amplitude : amplitudes[2]) EXPECT_NEAR(amplitude, 0.0, 1e-13);
  EXPECT_THROW(Spectrum(61, kFlutes, kSteps), core::InputError);
}

TEST(Figures, AreTheSameInPiecesAsInOne) {
  std::mt19937_64 random(9);
  const cutter::Cutter cutter = uneven_cutter(random);
  const ForceSampler sampler(cutter, slot(5.0), {}, 240, {}, true);
  const FigureRequest request = {4, true, 40.0};
  const Feed feed = {0.08, 0.3};
  FigureAccumulator whole(request, sampler), pieces(request, sampler);
  ForceSamples samples;
  sampler.sample(kGgg70, feed, 0, 240, samples);
  whole.add(sampler, kGgg70, feed, 0, 240, samples);
  for (const auto& [first, count] : {std::pair{0, 100}, {100, 7}, {107, 133}}) {
    sampler.sample(kGgg70, feed, first, count, samples);
    pieces.add(sampler, kGgg70, feed, first, count, samples);
  }
  const ForceFigures a = whole.result(), b = pieces.result();
  EXPECT_NEAR(a.statistics.x.mean, b.statistics.x.mean, 1e-9);
  EXPECT_EQ(a.bending_moment_max, b.bending_moment_max);
  EXPECT_EQ(a.chip_thickness_max, b.chip_thickness_max);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(a.harmonics[0][k], b.harmonics[0][k], 1e-9);
  for (int j = 0; j < cutter.flutes; ++j) {
    EXPECT_NEAR(a.flutes[j].load_share, b.flutes[j].load_share, 1e-12);
  }
}

TEST(Figures, SharesOfTheFlutesSumToOneAndAreEqualForEqualFlutes) {
  std::mt19937_64 random(10);
  const auto shares = [&](const cutter::Cutter& cutter) {
    const ForceSampler sampler(cutter, slot(5.0), {}, 240);
    ForceSamples samples;
    sampler.sample(kGgg70, {0.08}, 0, 240, samples);
    FigureAccumulator figures({0, true, {}}, sampler);
    figures.add(sampler, kGgg70, {0.08}, 0, 240, samples);
    return figures.result().flutes;
  };
  const auto uneven = shares(uneven_cutter(random));
  double sum = 0.0;
  for (const FluteFigures& flute : uneven) sum += flute.load_share;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  for (const FluteFigures& flute : shares(haber_cutter(cutter::Shape::ball))) {
    EXPECT_NEAR(flute.load_share, 0.5, 1e-12);
    EXPECT_DOUBLE_EQ(flute.chip_thickness_max, 0.08 * std::sqrt(35.0) / 6.0);
  }
}

/// A short cylinder high up: its force acts nearly at one height, and along z far from the axis.
TEST(Bending, IsForceTimesArmAboutTheHolder) {
  const cutter::Cutter flat = haber_cutter(cutter::Shape::flat);
  constexpr double kDepth = 1e-3, kStickOut = 50.0;
  Coefficients planar = kGgg70;
  planar.Kac = planar.Kae = 0.0;  // no force along z
  const ForceSampler sampler(flat, slot(kDepth), {}, 360, {}, true);
  ForceSamples samples;
  sampler.sample(planar, {0.06}, 0, 360, samples);
  FigureAccumulator figures({0, false, kStickOut}, sampler);
  figures.add(sampler, planar, {0.06}, 0, 360, samples);
  double largest = 0.0;
  for (int i = 0; i < 360; ++i) largest = std::max(largest, std::hypot(samples.x[i], samples.y[i]));
  EXPECT_NEAR(figures.result().bending_moment_max / (largest * (kStickOut - 0.5 * kDepth)), 1.0,
              1e-8);
}

TEST(Bending, MomentsAgreeWithTheSumOverDiscs) {
  std::mt19937_64 random(11);
  double worst = 0.0;
  for (int round = 0; round < 20; ++round) {
    testing::Case c =
        testing::random_case(random, round % 2 ? cutter::Shape::ball : cutter::Shape::flat);
    const ForceSampler exact(c.cutter, c.engagement, {}, 40, {}, true);
    const ForceSampler discs(c.cutter, c.engagement, {Rule::discs, 20000}, 40, {}, true);
    ForceSamples a, b;
    exact.sample_moments(c.coefficients, {c.feed_per_tooth, 0.5}, 0, 40, a);
    discs.sample_moments(c.coefficients, {c.feed_per_tooth, 0.5}, 0, 40, b);
    double peak = 0.0, off = 0.0;
    for (int i = 0; i < 40; ++i) {
      peak = std::max({peak, std::abs(a.x[i]), std::abs(a.y[i])});
      off = std::max({off, std::abs(a.x[i] - b.x[i]), std::abs(a.y[i] - b.y[i])});
    }
    if (peak > 0.0) worst = std::max(worst, off / peak);
  }
  EXPECT_LT(worst, 5e-3);
  std::cout << "moments against 20 000 discs: " << worst << " of the peak\n";
}

}  // namespace
}  // namespace millstudy::force
