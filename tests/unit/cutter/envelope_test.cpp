// SPDX-License-Identifier: MIT
#include "cutter/envelope.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/quadrature.h"
#include "core/units.h"

namespace millstudy::cutter {
namespace {

const Cutter kFlat{Shape::flat, 12.0, 2, core::rad_from_deg(30.0)};
const Cutter kBall{Shape::ball, 12.0, 2, core::rad_from_deg(-40.0)};

/// One of each shape, whose edge coefficients are per edge length.
std::vector<Cutter> general_cutters() {
  const double helix = core::rad_from_deg(35.0);
  const Cutter plain{.diameter = 12.0,
                     .flutes = 3,
                     .helix_angle = helix,
                     .edge_measure = EdgeMeasure::edge_length};
  std::vector<Cutter> all(7, plain);
  all[0].shape = Shape::flat;
  all[1].shape = Shape::ball;
  all[2].shape = Shape::bull_nose;
  all[2].corner_radius = 2.5;
  all[3].shape = Shape::taper;
  all[3].taper_angle = core::rad_from_deg(8.0);
  all[3].lead = Lead::constant_helix;
  all[4].shape = Shape::ball;
  all[4].taper_angle = core::rad_from_deg(5.0);
  all[5].shape = Shape::general;
  all[5].corner_radius = 1.5;
  all[5].tip_angle = core::rad_from_deg(10.0);
  all[5].taper_angle = core::rad_from_deg(-6.0);
  all[6].shape = Shape::profile;
  all[6].profile =
      std::make_shared<const Profile>(Profile{{0.0, 2.0}, {1.0, 4.0}, {4.0, 6.0}, {9.0, 6.0}});
  return all;
}

TEST(Envelope, OfAFlatCutterIsACylinder) {
  for (const double z : {0.0, 0.5, 30.0}) {
    EXPECT_EQ(envelope(kFlat, z).radius, 6.0);
    EXPECT_EQ(envelope(kFlat, z).kappa, 0.5 * core::kPi);
  }
}

TEST(Envelope, LagGrowsByTheTangentOfTheHelixOverTheRadius) {
  EXPECT_DOUBLE_EQ(envelope(kFlat, 2.0).lag_angle, 2.0 * std::tan(core::kPi / 6.0) / 6.0);
  EXPECT_DOUBLE_EQ(envelope(kBall, 2.0).lag_angle, -2.0 * std::tan(core::kPi / 4.5) / 6.0);
}

TEST(Envelope, OfABallIsASphereUpToItsEquator) {
  for (const double z : {1e-12, 1e-3, 0.5, 3.0, 5.9, 5.9999999}) {
    const EnvelopePoint point = envelope(kBall, z);
    EXPECT_NEAR(std::hypot(point.radius, 6.0 - z), 6.0, 1e-15 * 12.0);
    // Normal against the axis: r = R sin(kappa), z = R (1 - cos(kappa)); the latter without loss.
    EXPECT_NEAR(6.0 * std::sin(point.kappa) / point.radius, 1.0, 4e-16);
    EXPECT_NEAR(12.0 * std::pow(std::sin(0.5 * point.kappa), 2) / z, 1.0, 1e-15);
  }
  EXPECT_EQ(envelope(kBall, 0.0).kappa, 0.0);
  EXPECT_EQ(envelope(kBall, 6.0).radius, 6.0);
  EXPECT_EQ(envelope(kBall, 40.0).radius, 6.0);
}

TEST(SectionArea, KeepsItsDigitsAtTheTip) {
  for (const double depth : {1e-3, 1e-6, 1e-10, 1e-14, 1e-18}) {
    // Integral of sqrt(z (D - z)) for depth << D; the next term is 3 depth^2 / (56 D^2).
    const double limit =
        2.0 / 3.0 * std::sqrt(12.0) * std::pow(depth, 1.5) * (1.0 - 0.3 * depth / 12.0);
    EXPECT_NEAR(section_area(Envelope(kBall), depth) / limit, 1.0, 1e-9) << depth;
    if (depth <= 1e-6) {
      EXPECT_NEAR(section_area(Envelope(kBall), depth) / limit, 1.0, 2e-14) << depth;
    }
  }
}

TEST(SectionArea, IsTheIntegralOfTheRadius) {
  const core::GaussRule& rule = core::gauss_legendre(40);
  for (const double depth : {0.01, 0.5, 3.0, 6.0, 9.5}) {
    const double curved = std::min(depth, 6.0);
    double area = 6.0 * (depth - curved);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double s =
          0.5 * (1.0 + rule.nodes[i]);  // z = curved s^2: the root at the tip is smooth
      area += rule.weights[i] * curved * s * envelope(kBall, curved * s * s).radius;
    }
    EXPECT_NEAR(section_area(Envelope(kBall), depth), area, 1e-15 * 36.0);
    EXPECT_DOUBLE_EQ(section_area(Envelope(kFlat), depth), 6.0 * depth);
  }
}

TEST(LargestSinKappa, GrowsToOneAtTheEquator) {
  EXPECT_DOUBLE_EQ(largest_sin_kappa(Envelope(kBall), 1.0), std::sqrt(11.0) / 6.0);
  EXPECT_EQ(largest_sin_kappa(Envelope(kBall), 6.0), 1.0);
  EXPECT_EQ(largest_sin_kappa(Envelope(kFlat), 0.1), 1.0);
}

/// (C10) of a cutter's own helix at a height.
double edge_per_width(const Cutter& cutter, double z) {
  const Envelope shape(cutter);
  const EnvelopePoint point = envelope(cutter, z);
  return shape.edge_per_width(std::tan(cutter.helix_angle), point.radius, std::sin(point.kappa),
                              shape.lag_slope(z));
}

TEST(EdgePerWidth, IsOneWhereEdgeCoefficientsArePerChipWidth) {
  EXPECT_EQ(edge_per_width(kFlat, 2.0), 1.0);
  Cutter ball = kBall;
  ball.edge_measure = EdgeMeasure::chip_width;
  EXPECT_EQ(edge_per_width(ball, 2.0), 1.0);
  Cutter flat = kFlat;
  flat.edge_measure = EdgeMeasure::edge_length;
  EXPECT_DOUBLE_EQ(edge_per_width(flat, 2.0), 1.0 / std::cos(flat.helix_angle));
}

TEST(EdgePerWidth, IsTheArcLengthOfTheEdgeInSpace) {
  // (C1) at spindle angle 0, differenced over a short piece; db = dz / sin(kappa).
  for (const Cutter& cutter : general_cutters()) {
    const Envelope shape(cutter);
    const auto edge = [&](double z) {
      const EnvelopePoint point = envelope(cutter, z);
      return std::array{point.radius * std::sin(point.lag_angle),
                        point.radius * std::cos(point.lag_angle), z};
    };
    constexpr double kStep = 1e-4;
    for (const double z : {0.3, 1.1, 2.7, 5.2, 8.3}) {
      const auto low = edge(z - kStep);
      const auto high = edge(z + kStep);
      const double length = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
      const double width = 2.0 * kStep / std::sin(envelope(cutter, z).kappa);
      EXPECT_NEAR(edge_per_width(cutter, z), length / width, 1e-6) << z;
    }
  }
}

TEST(Cutter, OutOfRangeIsRefusedByName) {
  const auto message = [](const Cutter& cutter) -> std::string {
    try {
      check(cutter);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(kFlat), "");
  EXPECT_EQ(message({Shape::flat, 12.0, 2, core::rad_from_deg(80.0)}), "");
  EXPECT_NE(message({Shape::flat, -1.0, 2, 0.0}).find("diameter = -1"), std::string::npos);
  EXPECT_NE(message({Shape::flat, kNaN, 2, 0.0}).find("diameter = nan"), std::string::npos);
  EXPECT_NE(message({Shape::flat, 12.0, 0, 0.0}).find("flutes = 0"), std::string::npos);
  EXPECT_NE(message({Shape::flat, 12.0, 2, 1.5}).find("helix_angle = 85.9"), std::string::npos);
  EXPECT_NE(message({Shape::flat, 12.0, 2, kNaN}).find("helix_angle = nan"), std::string::npos);
}

}  // namespace
}  // namespace millstudy::cutter
