// SPDX-License-Identifier: MIT
// What must be the same, is: shapes as cases of the general end mill, uneven flutes that are even,
// coefficients that vary by nothing; and what must be conserved.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <iostream>
#include <numeric>

#include "core/quadrature.h"
#include "force/chip_law.h"
#include "force/nonlinear_force.h"
#include "force/sampler.h"
#include "unit/force/cases.h"

namespace millstudy::force {
namespace {

using cutter::Cutter;
using cutter::Shape;
using testing::Force;
using testing::kGgg70;
using testing::uniform;

constexpr double kSame = 1e-12;

/// Forces of one revolution in a turned feed frame, as the sampler makes them.
std::vector<Force> revolution(const Cutter& cutter, const Engagement& engagement,
                              const Variation& variation = {}) {
  constexpr int kSteps = 90;
  ForceSamples samples;
  ForceSampler(cutter, engagement, {}, kSteps, variation)
      .sample(kGgg70, {0.07, 0.4}, 0, kSteps, samples);
  std::vector<Force> forces;
  for (int i = 0; i < kSteps; ++i) {
    forces.push_back({samples.x[i], samples.y[i], samples.z[i], samples.torque[i]});
  }
  return forces;
}

/// Largest difference relative to the peak.
double difference(const std::vector<Force>& a, const std::vector<Force>& b, double radius) {
  double peak = 0.0, off = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    peak = std::max(peak, testing::distance(a[i], Force{}, radius));
    off = std::max(off, testing::distance(a[i], b[i], radius));
  }
  return off / peak;
}

/// Compares two cutters in many cuts: several helix angles, depths and arcs.
void expect_same(const char* what, Cutter a, Cutter b) {
  double worst = 0.0;
  for (const double helix_deg : {-40.0, 0.0, 30.0, 55.0}) {
    for (const double depth : {0.3, 2.0, 7.0}) {
      for (const Engagement& engagement :
           {slot(depth), up_milling(6.0, 2.0, depth), down_milling(6.0, 4.0, depth)}) {
        a.helix_angle = b.helix_angle = core::rad_from_deg(helix_deg);
        worst =
            std::max(worst, difference(revolution(a, engagement), revolution(b, engagement), 6.0));
      }
    }
  }
  EXPECT_LT(worst, kSame) << what;
  std::cout << what << ": " << worst << " of the peak\n";
}

Cutter of(Shape shape) {
  return {.shape = shape, .diameter = 12.0, .flutes = 3};
}

TEST(GeneralEndMill, IsEveryOtherShape) {
  Cutter general = of(Shape::general);
  expect_same("general = flat", general, of(Shape::flat));

  general.corner_radius = 2.5;
  Cutter bull = of(Shape::bull_nose);
  bull.corner_radius = 2.5;
  expect_same("general = bull-nose", general, bull);

  general.corner_centre_radius = 3.5;
  general.corner_centre_height = 2.5;
  expect_same("general with its corner's centre given = bull-nose", general, bull);
  general.corner_centre_radius.reset();
  general.corner_centre_height.reset();

  general.corner_radius = 6.0;
  expect_same("general = ball", general, of(Shape::ball));

  general.corner_radius = 1.0;
  general.taper_angle = core::rad_from_deg(7.0);
  Cutter taper = of(Shape::taper);
  taper.corner_radius = 1.0;
  taper.taper_angle = general.taper_angle;
  expect_same("general = taper", general, taper);
}

TEST(BullNose, WithCornersOfNothingIsFlatAndOfHalfTheDiameterABall) {
  Cutter bull = of(Shape::bull_nose);
  expect_same("corner radius 0 = flat", bull, of(Shape::flat));
  bull.corner_radius = 6.0;
  expect_same("corner radius D/2 = ball", bull, of(Shape::ball));
}

/// With one edge measure said outright, a corner that vanishes leaves a flat cutter.
TEST(BullNose, TendsToTheFlatCutterAsItsCornerVanishes) {
  Cutter flat = of(Shape::flat), bull = of(Shape::bull_nose);
  flat.edge_measure = bull.edge_measure = cutter::EdgeMeasure::edge_length;
  flat.helix_angle = bull.helix_angle = 0.5;
  for (const double corner : {1e-3, 1e-5, 1e-7}) {
    bull.corner_radius = corner;
    const double off = difference(revolution(flat, slot(2.0)), revolution(bull, slot(2.0)), 6.0);
    EXPECT_LT(off, 2.0 * corner);
  }
}

TEST(Taper, OfNoAngleIsFlatWithEitherLead) {
  Cutter taper = of(Shape::taper);
  expect_same("taper 0 = flat", taper, of(Shape::flat));
  taper.lead = cutter::Lead::constant_helix;
  expect_same("taper 0 with constant helix = flat", taper, of(Shape::flat));
}

TEST(Profile, OfTwoPointsIsATaper) {
  Cutter taper = of(Shape::taper), profile = of(Shape::profile);
  taper.taper_angle = std::atan(0.1);
  profile.profile =
      std::make_shared<const cutter::Profile>(cutter::Profile{{0.0, 6.0}, {4.0, 6.4}, {20.0, 8.0}});
  expect_same("profile = taper", profile, taper);
}

TEST(Flutes, ListedAsEqualArePlain) {
  for (const Shape shape : {Shape::flat, Shape::ball}) {
    Cutter listed = of(shape);
    listed.pitch_angles.assign(3, 2.0 * core::kPi / 3.0);
    expect_same("equal listed pitch = plain", listed, of(shape));
    Cutter nearly = of(shape);
    nearly.pitch_angles = {2.0 * core::kPi / 3.0 + 1e-15, 2.0 * core::kPi / 3.0 - 1e-15,
                           2.0 * core::kPi / 3.0};
    expect_same("as equal as rounding lets them be = plain", nearly, of(shape));
  }
}

TEST(Runout, OfNothingIsTheLinearForce) {
  std::mt19937_64 random(31);
  double worst = 0.0;
  for (int round = 0; round < 200; ++round) {
    testing::Case c = testing::random_case(random, round % 2 ? Shape::ball : Shape::flat);
    const Arc arc = c.engagement.arc();
    const NonlinearForce nonlinear(
        std::make_shared<const CuttingEdges>(c.cutter, c.engagement.axial_depth, Variation{}), {});
    const double phi = uniform(random, 0.0, 6.0);
    Force sum{};
    for (int j = 0; j < c.cutter.flutes; ++j) {
      const Force of_flute =
          nonlinear.of_flute(j, phi + j * cutter::pitch_angle(c.cutter), std::span(&arc, 1),
                             c.coefficients, {c.feed_per_tooth}, Rows::forces);
      for (int row = 0; row < kRows; ++row) sum[row] += of_flute[row];
    }
    const double peak = testing::peak_force(c);
    if (peak == 0.0) continue;
    const double off =
        testing::distance(sum, testing::exact_force(c, phi), 0.5 * c.cutter.diameter);
    worst = std::max(worst, off / peak);
  }
  EXPECT_LT(worst, kSame);
  std::cout << "nonlinear path without runout = linear path: " << worst << " of the peak\n";
  Cutter still = of(Shape::ball), plain = of(Shape::ball);
  still.runout = {1e-300, 1.0, 0.0, 0.0};  // takes the way of runout
  expect_same("runout of nothing = plain", still, plain);
}

/// The surface moves by one feed a revolution, whoever cuts it.
TEST(Runout, RemovesTheMaterialThatIsThere) {
  std::mt19937_64 random(32);
  double worst = 0.0;
  for (int round = 0; round < 100; ++round) {
    Cutter cutter = of(round % 2 ? Shape::bull_nose : Shape::ball);
    cutter.corner_radius = 2.0;
    cutter.flutes = 1 + static_cast<int>(random() % 6);
    cutter.helix_angle = uniform(random, -0.8, 0.8);
    cutter.runout = {uniform(random, 0.0, 0.3), uniform(random, 0.0, 6.0),
                     uniform(random, 0.0, 0.002), uniform(random, 0.0, 6.0)};
    const double depth = uniform(random, 0.5, 8.0), feed = uniform(random, 0.02, 0.1);
    const CuttingEdges edges(cutter, depth, {});
    const ChipLaw law(edges);
    std::vector<Reach> reaches(law.reaches());
    const Arc arc = {uniform(random, 0.0, 1.0), uniform(random, 1.1, core::kPi)};
    // Chip area h db of all flutes, over the arc and the depth; the chip is constant in sum, so
    // any rule that is exact for the sines does.
    double area = 0.0;
    const core::GaussRule& rule = core::gauss_legendre(20);
    for (const EdgePiece& piece : edges.pieces()) {
      edges.for_each_node(piece, 0.0, piece.bottom, piece.top, [&](const EdgeNode& node) {
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
          const double half = 0.5 * (arc.exit_angle - arc.entry_angle);
          const double phi = arc.entry_angle + half * (1.0 + rule.nodes[i]);
          for (int j = 0; j < cutter.flutes; ++j) {
            law.find(j, edge_point(edges.envelope(), edges.flutes()[j].helix_tangent, node.z),
                     reaches);
            area +=
                half * rule.weights[i] * node.width *
                ChipLaw::thickness(reaches, {feed}, std::sin(phi), node.sin_kappa, node.cos_kappa);
          }
        }
      });
    }
    const double there =
        cutter.flutes * feed * depth * (std::cos(arc.entry_angle) - std::cos(arc.exit_angle));
    worst = std::max(worst, std::abs(area / there - 1.0));
  }
  EXPECT_LT(worst, 1e-9);
  std::cout << "chip areas of a revolution against feed x width x depth: " << worst << '\n';
}

TEST(Variation, ByNothingChangesNothing) {
  for (const Shape shape : {Shape::flat, Shape::ball}) {
    Cutter cutter = of(shape);
    cutter.helix_angle = 0.6;
    const auto plain = revolution(cutter, slot(3.0));
    HeightFactors ones;
    ones.heights = {0.5, 2.0};
    ones.table.fill({1.0, 1.0});
    Variation table;
    table.height = std::make_shared<const HeightFactors>(ones);
    HeightFactors zeros;
    zeros.polynomial.fill({0.0, 0.0, 0.0, 0.0});
    Variation polynomial;
    polynomial.height = std::make_shared<const HeightFactors>(zeros);
    Variation exponent;
    exponent.reference_chip_thickness = 0.01;  // of no effect with m = 0
    for (const Variation& variation : {table, polynomial, exponent}) {
      const double off = difference(plain, revolution(cutter, slot(3.0), variation), 6.0);
      EXPECT_LT(off, kSame);
      std::cout << "coefficients that vary by nothing: " << off << " of the peak\n";
    }
    // The nearest thing to m = 0 that takes the way of the size effect.
    Variation hardly;
    hardly.size_exponent = {1e-16, 1e-16, 1e-16};
    const double off = difference(plain, revolution(cutter, slot(3.0), hardly), 6.0);
    EXPECT_LT(off, kSame);
    std::cout << "size effect of m = 1e-16: " << off << " of the peak\n";
  }
}

TEST(Discs, ConvergeToTheExactForceOnEveryShape) {
  Cutter bull = of(Shape::bull_nose), taper = of(Shape::taper);
  bull.corner_radius = 3.0;
  taper.taper_angle = 0.15;
  taper.corner_radius = 0.5;
  for (Cutter cutter : {of(Shape::flat), of(Shape::ball), bull, taper}) {
    cutter.helix_angle = 0.5;
    const auto exact = revolution(cutter, slot(3.0));
    double last = 1.0;
    for (const int discs : {100, 1600, 25600}) {
      ForceSamples samples;
      ForceSampler(cutter, slot(3.0), {Rule::discs, discs}, 90)
          .sample(kGgg70, {0.07, 0.4}, 0, 90, samples);
      std::vector<Force> forces;
      for (int i = 0; i < 90; ++i) {
        forces.push_back({samples.x[i], samples.y[i], samples.z[i], samples.torque[i]});
      }
      const double off = difference(exact, forces, 6.0);
      std::cout << discs << " discs: " << off << " of the peak\n";
      EXPECT_LT(off, 0.5 * last);
      last = off;
    }
  }
}

}  // namespace
}  // namespace millstudy::force
