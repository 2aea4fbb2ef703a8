// SPDX-License-Identifier: MIT
#include "process/bend.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "paths.h"

namespace millstudy::process {
namespace {

using testing::circle;
using testing::corner;
using testing::path_of;
using testing::straight;

constexpr double kReach = 20.0;

TEST(Bend, OfAStraightPathIsNoneToTheBit) {
  std::mt19937_64 random(1);
  for (unsigned n = 0; n < testing::random_count(300); ++n) {
    const double chord = std::pow(10.0, testing::uniform(random, -3.0, 0.0));
    path::Interpolation path = straight(300, chord, testing::uniform(random, -4.0, 4.0));
    const path::Vec3 start{testing::uniform(random, -300.0, 300.0),
                           testing::uniform(random, -300.0, 300.0), 0.0};
    for (path::Vec3& point : path.points) point = point + start;
    for (const Bend& bend : bends_of(path, kReach)) {
      ASSERT_EQ(bend.curvature, 0.0);
      ASSERT_EQ(bend.turning_ahead, 0.0);
    }
  }
}

TEST(Bend, OfACircleIsItsOwn) {
  for (const double curvature : {0.5, 0.05, -0.05, -0.002}) {
    const path::Interpolation path = circle(700, 0.06, curvature, 0.4);
    for (const Bend& bend : bends_of(path, kReach)) {
      ASSERT_NEAR(bend.curvature, curvature, 1e-9);
      // Beyond the end it goes on as a circle.
      ASSERT_NEAR(bend.turning_ahead, std::abs(curvature) * kReach, std::abs(curvature) * 0.07);
    }
  }
}

/// Largest error of the curvature along half an ellipse whose chords vary by a factor of 2, apart
/// from the first and the last period.
/// @param unevenness  0: smoothly; up to 1: chords of three lengths, apart by up to that part
double error_on_an_ellipse(int periods, double unevenness) {
  constexpr double a = 40.0, b = 20.0;
  std::vector<path::Vec3> points;
  std::vector<double> parameters;
  for (int i = 0; i <= periods; ++i) {
    const double t = core::kPi * (i + (i % 3 == 1) * 0.5 * unevenness) / periods;
    parameters.push_back(t);
    points.push_back({a * std::cos(t), b * std::sin(t), 0.0});
  }
  const std::vector<Bend> bends = bends_of(path_of(points), kReach);
  double largest = 0.0;
  for (int i = 1; i + 1 < periods; ++i) {
    const double t = 0.5 * (parameters[i] + parameters[i + 1]);
    const double speed = std::hypot(a * std::sin(t), b * std::cos(t));
    largest = std::max(largest, std::abs(bends[i].curvature - a * b / std::pow(speed, 3)));
  }
  return largest;
}

TEST(Bend, IsOfSecondOrderInTheChord) {
  for (const double unevenness : {0.0, 0.8}) {
    const double coarse = error_on_an_ellipse(500, unevenness);
    const double fine = error_on_an_ellipse(1000, unevenness);
    EXPECT_LT(fine, 8e-6);  // of up to 0.1 per mm, with chords of 0.06 to 0.13 mm
    EXPECT_NEAR(coarse / fine, 4.0, 0.3);
  }
}

TEST(Bend, IsNotLedAstrayByAPartialStep) {
  for (const double part : {0.5, 0.1, 1e-3, 1e-6, 1e-10}) {
    path::Interpolation path = circle(200, 0.06, 0.05, 0.4);
    const path::Interpolation short_steps = circle(200, 0.06 * part, 0.05, 0.4);
    // The last point of the circle, and one a partial step further on it.
    const double turned = 200 * 2.0 * std::asin(0.5 * 0.06 * 0.05);
    const path::Vec3 step = short_steps.points[1];
    path.points.push_back(path.points.back() +
                          path::Vec3{step.x * std::cos(turned) - step.y * std::sin(turned),
                                     step.x * std::sin(turned) + step.y * std::cos(turned), 0.0});
    for (const Bend& bend : bends_of(path, kReach)) {
      ASSERT_NEAR(bend.curvature, 0.05, 1e-6) << part;
    }
  }
}

TEST(Bend, OfACornerIsItsTurnWithinReach) {
  const path::Interpolation path = corner(500, 0.06, -1.2);
  const std::vector<Bend> bends = bends_of(path, kReach);
  for (int i = 0; i < 1000; ++i) {
    const double to_corner = (500 - i - 0.5) * 0.06;
    if (to_corner < 0.0 || to_corner > kReach) {
      EXPECT_EQ(bends[i].turning_ahead, 0.0) << i;
    } else {
      EXPECT_NEAR(bends[i].turning_ahead, 1.2, 1e-9) << i;
    }
    if (i < 499 || i > 500) {
      EXPECT_EQ(bends[i].curvature, 0.0) << i;
    } else {
      EXPECT_LT(bends[i].curvature, -5.0) << i;
    }
  }
}

TEST(Bend, OfACornerAtTheEndDoesNotGoOn) {
  path::Interpolation path = corner(100, 0.06, 1.0);
  path.points.resize(102);  // one period beyond the corner
  EXPECT_EQ(bends_of(path, kReach).back().turning_ahead, 0.0);
}

TEST(Bend, OfATurnStraightBackIsNone) {
  path::Interpolation path = straight(10, 0.06, 0.3);
  for (int i = 9; i >= 0; --i) path.points.push_back(path.points[i]);
  for (const Bend& bend : bends_of(path, kReach)) {
    EXPECT_EQ(bend.curvature, 0.0);
    EXPECT_EQ(bend.turning_ahead, 0.0);
  }
}

TEST(Bend, GoesOnOverARest) {
  path::Interpolation path = circle(200, 0.06, 0.05, 0.4);
  path.points.insert(path.points.begin() + 100, 30, path.points[100]);
  path.points.insert(path.points.begin(), 5, path.points[0]);
  path.points.insert(path.points.end(), 5, path.points.back());
  for (const Bend& bend : bends_of(path, kReach)) EXPECT_NEAR(bend.curvature, 0.05, 1e-9);
}

TEST(Bend, OfOnePeriodIsNone) {
  EXPECT_EQ(bends_of(straight(1, 0.06, 0.1), kReach).size(), 1u);
  EXPECT_EQ(bends_of(straight(1, 0.0, 0.1), kReach).front().curvature, 0.0);
}

}  // namespace
}  // namespace millstudy::process
