// SPDX-License-Identifier: MIT
#include "cutter/envelope.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/error.h"
#include "core/quadrature.h"
#include "core/units.h"

namespace millstudy::cutter {
namespace {

const Cutter kFlat{Shape::flat, 12.0, 2, core::rad_from_deg(30.0)};
const Cutter kBall{Shape::ball, 12.0, 2, core::rad_from_deg(-40.0)};

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
    EXPECT_NEAR(section_area(kBall, depth) / limit, 1.0, 1e-9) << depth;
    if (depth <= 1e-6) {
      EXPECT_NEAR(section_area(kBall, depth) / limit, 1.0, 2e-14) << depth;
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
    EXPECT_NEAR(section_area(kBall, depth), area, 1e-15 * 36.0);
    EXPECT_DOUBLE_EQ(section_area(kFlat, depth), 6.0 * depth);
  }
}

TEST(LargestSinKappa, GrowsToOneAtTheEquator) {
  EXPECT_DOUBLE_EQ(largest_sin_kappa(kBall, 1.0), std::sqrt(11.0) / 6.0);
  EXPECT_EQ(largest_sin_kappa(kBall, 6.0), 1.0);
  EXPECT_EQ(largest_sin_kappa(kFlat, 0.1), 1.0);
}

TEST(EdgeLengthRate, ContinuesTheArcLengthOfTheBall) {
  EXPECT_EQ(edge_length_rate(kFlat), 1.0);
  EXPECT_DOUBLE_EQ(edge_length_rate(kBall), std::hypot(1.0, std::tan(kBall.helix_angle)));
}

TEST(BallEdgePerWidth, IsTheArcLengthOfTheEdgeInSpace) {
  // (C1) at spindle angle 0, differenced over a short piece; db = R dkappa.
  const auto edge = [](double kappa) {
    const EnvelopePoint point = envelope(kBall, 6.0 * (1.0 - std::cos(kappa)));
    return std::array{point.radius * std::sin(point.lag_angle),
                      point.radius * std::cos(point.lag_angle), 6.0 * (1.0 - std::cos(kappa))};
  };
  constexpr double kStep = 1e-4;
  for (const double kappa : {0.1, 0.5, 1.0, 1.5}) {
    const auto low = edge(kappa - kStep);
    const auto high = edge(kappa + kStep);
    const double length = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    const double rate = curved_edge_per_width(kBall, std::sin(kappa));
    EXPECT_NEAR(rate, length / (6.0 * 2.0 * kStep), 1e-8);
    EXPECT_EQ(rate, ball_edge_per_width(std::tan(-kBall.helix_angle), std::sin(kappa)));
  }
  EXPECT_DOUBLE_EQ(curved_edge_per_width(kBall, 1.0), edge_length_rate(kBall));
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
