// SPDX-License-Identifier: MIT
// Numbers printed in the paper and in the literature, to every digit given. Each test prints how
// far away it is.
#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "path/figures.h"
#include "unit/path/test_curves.h"

namespace millstudy::path {
namespace {

/// Rounded to the digits that a number is given with.
void expect_printed(const std::string& what, double value, double printed, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(printed))) - digits + 1);
  fmt::print("  {:<28} {:.6g}, printed {:.6g}: off by {:.2f} of its last digit\n", what, value,
             printed, (value - printed) / unit);
  EXPECT_NEAR(value, printed, 0.5000001 * unit) << what;
}

PathFigures figures(const CurveData& data, Method method, int iterations, double chord = 0.12) {
  const Curve curve(data);
  InterpolationSettings settings;
  settings.method = method;
  settings.period = 0.002;
  settings.feed_rate = chord / settings.period;
  settings.max_iterations = iterations;
  return path_figures(curve, interpolate(curve, settings));
}

// Source: sun2008, Table 1 and section 4; REFERENCE.md 1.
TEST(Table1, LengthTimeStepsAndChordError) {
  const PathFigures f = figures(test::sun2008(), Method::newton, 2);
  expect_printed("arc length", f.path_length, 41.36045561601, 13);
  expect_printed("chord error um", 1e3 * f.chord_error_max, 4.86, 3);
  EXPECT_EQ(f.steps, 344.0);
  EXPECT_NEAR(f.path_time, 0.690, 1e-12);
  EXPECT_EQ(f.fallback_steps, 0.0);
}

TEST(Table1, SmallestRadius) {
  const Curve curve(test::sun2008());
  double smallest = HUGE_VAL;
  double where = 0.0;
  for (int i = 0; i <= 500000; ++i) {  // the other half has its mirror image
    const double u = i * 1e-6;
    const CurvePoint c = curve.evaluate(u);
    const double radius = std::pow(norm(c.first), 3) / norm(cross(c.first, c.second));
    if (radius < smallest) {
      smallest = radius;
      where = u;
    }
  }
  expect_printed("smallest radius", smallest, 0.36878, 5);
  expect_printed("at u", where, 0.377, 3);
}

TEST(Table1, Taylor1) {
  const PathFigures f = figures(test::sun2008(), Method::taylor1, 1);
  expect_printed("max", f.feed_fluctuation_max, 6.6316, 5);
  expect_printed("rms", f.feed_fluctuation_rms, 2.20, 3);
  EXPECT_EQ(f.steps, 344.0);
  EXPECT_NEAR(f.path_time, 0.690, 1e-12);
  EXPECT_NEAR(f.curve_evaluations / f.steps, 1.0, 0.01);
}

TEST(Table1, Taylor2) {
  const PathFigures f = figures(test::sun2008(), Method::taylor2, 1);
  expect_printed("max", f.feed_fluctuation_max, 1.5246, 5);
  expect_printed("rms", f.feed_fluctuation_rms, 0.248, 3);
  EXPECT_EQ(f.steps, 344.0);
  EXPECT_NEAR(f.curve_evaluations / f.steps, 1.0, 0.01);
}

TEST(Table1, Newton1) {
  const PathFigures f = figures(test::sun2008(), Method::newton, 1);
  expect_printed("max", f.feed_fluctuation_max, 2.556e-2, 4);
  expect_printed("rms", f.feed_fluctuation_rms, 5.3e-3, 2);
  EXPECT_EQ(f.steps, 344.0);
  EXPECT_NEAR(f.curve_evaluations / f.steps, 2.0, 0.01);
}

TEST(Table1, Newton2) {
  const PathFigures f = figures(test::sun2008(), Method::newton, 2);
  expect_printed("max", f.feed_fluctuation_max, 3.7942e-7, 5);
  expect_printed("rms", f.feed_fluctuation_rms, 5.5e-8, 2);
  EXPECT_EQ(f.steps, 344.0);
  EXPECT_NEAR(f.curve_evaluations / f.steps, 3.0, 0.01);
}

TEST(Table1, Newton3ReachesTheRoundingFloor) {
  for (const int n : {3, 4}) {
    const PathFigures f = figures(test::sun2008(), Method::newton, n);
    fmt::print("  N = {}: max {:.3g} (floor 4.3e-12), rms {:.3g} (1.2e-12)\n", n,
               f.feed_fluctuation_max, f.feed_fluctuation_rms);
    EXPECT_LT(f.feed_fluctuation_max, 3 * 4.3e-12);
    EXPECT_LT(f.feed_fluctuation_rms, 3 * 1.2e-12);
    EXPECT_GT(f.feed_fluctuation_max, 4.3e-12 / 3);
    EXPECT_NEAR(f.curve_evaluations / f.steps, n + 1, 0.01 * (n + 1));
    EXPECT_EQ(f.fallback_steps, 0.0);
  }
}

TEST(Table1, ArcLengthTableReachesTheFloorOfChordAgainstArc) {
  const PathFigures f = figures(test::sun2008(), Method::arc_length_table, 1);
  // kappa^2 (VT)^2 / 24 at the smallest radius is 0.44 %; the sharpest step averages the curvature
  // about that radius and has 0.4277 %, for any table fine enough.
  const double floor = 100.0 * std::pow(0.12 / 0.36878, 2) / 24.0;
  expect_printed("floor", floor, 0.44, 2);
  expect_printed("max", f.feed_fluctuation_max, 0.4277, 4);
  EXPECT_LT(f.feed_fluctuation_max, floor);
  EXPECT_EQ(f.steps, 344.0);
}

TEST(Table1, PredictorCorrectorConvergesWithItsCorrections) {
  const double one = figures(test::sun2008(), Method::predictor_corrector, 1).feed_fluctuation_max;
  const double two = figures(test::sun2008(), Method::predictor_corrector, 2).feed_fluctuation_max;
  const double ten = figures(test::sun2008(), Method::predictor_corrector, 10).feed_fluctuation_max;
  fmt::print("  N = 1: {:.3g}, 2: {:.3g}, 10: {:.3g} percent\n", one, two, ten);
  EXPECT_LT(one, 1.0);
  EXPECT_LT(two, 0.2 * one);
  EXPECT_LT(ten, 3 * 4.3e-12);
}

// Source: Hu et al. 2023; figures from REFERENCE.md 1.
TEST(Butterfly, LengthAndSteps) {
  const PathFigures f = figures(test::butterfly(), Method::newton, 5);
  // Printed as 382.859, cut off rather than rounded: complex-step derivatives of the de Boor
  // recursion and 20-point Gauss on 16 parts of every span gave the digits below.
  expect_printed("arc length", f.path_length, 382.8595583013, 13);
  EXPECT_EQ(f.steps, 3189.0);
  fmt::print("  fallback steps {}\n", f.fallback_steps);
  EXPECT_EQ(f.fallback_steps, 0.0);
}

TEST(Butterfly, TaylorMethods) {
  expect_printed("taylor1", figures(test::butterfly(), Method::taylor1, 1).feed_fluctuation_max, 75,
                 2);
  expect_printed("taylor2", figures(test::butterfly(), Method::taylor2, 1).feed_fluctuation_max,
                 458, 3);
}

TEST(Butterfly, NewtonByIterations) {
  const auto newton = [](int n) {
    const PathFigures f = figures(test::butterfly(), Method::newton, n);
    fmt::print("  N = {}: fallback steps {}, evaluations per step {:.3f}\n", n, f.fallback_steps,
               f.curve_evaluations / f.steps);
    EXPECT_NEAR(f.curve_evaluations / f.steps, n + 1, 0.01 * (n + 1));
    return f.feed_fluctuation_max;
  };
  expect_printed("N1", newton(1), 24.8, 3);
  expect_printed("N2", newton(2), 0.102, 3);
  expect_printed("N3", newton(3), 8.0e-5, 2);
  const double floor = newton(5);
  fmt::print("  N5 {:.3g}, the rounding floor (3.8e-11)\n", floor);
  EXPECT_LT(floor, 3 * 3.8e-11);
}

TEST(Trident, NewtonByIterations) {
  const auto newton = [](int n) {
    return figures(test::trident(), Method::newton, n).feed_fluctuation_max;
  };
  expect_printed("N1", newton(1), 0.66, 2);
  expect_printed("N2", newton(2), 6.8e-4, 2);
  expect_printed("N3", newton(3), 7.2e-10, 2);
}

TEST(Trident, WithItsFirstPointDoubledStartsWithoutSpeed) {
  CurveData data = test::trident();
  data.points.insert(data.points.begin(), data.points.front());
  data.knots = clamped_uniform_knots(3, 8);
  ASSERT_LT(norm(Curve(data).evaluate(0.0).first), 1e-13);
  for (const Method method : {Method::taylor1, Method::taylor2, Method::predictor_corrector,
                              Method::arc_length_table, Method::newton}) {
    const PathFigures f = figures(data, method, 20);
    EXPECT_GT(f.steps, 100.0) << static_cast<int>(method);
    EXPECT_TRUE(std::isfinite(f.feed_fluctuation_max));
    if (method == Method::newton) {
      fmt::print("  max {:.3g} percent, {} fallback steps\n", f.feed_fluctuation_max,
                 f.fallback_steps);
      EXPECT_LT(f.feed_fluctuation_max, 1e-8);
      EXPECT_GE(f.fallback_steps, 1.0);
      EXPECT_LE(f.fallback_steps, 2.0);
    }
  }
}

}  // namespace
}  // namespace millstudy::path
