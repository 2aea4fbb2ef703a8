// SPDX-License-Identifier: MIT
#include "path/curve.h"

#include <cmath>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "path/arc_length.h"
#include "path/reference_curve.h"
#include "unit/path/test_curves.h"

namespace millstudy::path {
namespace {

double polygon_size(const CurveData& data) {
  double size = 0.0;
  for (const Vec3& p : data.points) size = std::max(size, norm(p - data.points.front()));
  return size;
}

TEST(Curve, AgreesWithTheReferenceEvaluationOnRandomCurves) {
  double worst = 0.0;
  double worst_first = 0.0;
  double worst_second = 0.0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const CurveData data = test::random_curve(seed);
    ASSERT_TRUE(faults(data).empty()) << seed << ": " << faults(data).front();
    const Curve curve(data);
    const ReferenceCurve reference(data);
    ASSERT_EQ(curve.begin(), reference.begin());
    ASSERT_EQ(curve.end(), reference.end());
    const double size = polygon_size(data);
    for (int i = 0; i <= 50; ++i) {
      const double u = curve.begin() + (curve.end() - curve.begin()) * (i + 0.37) / 50.5;
      const CurvePoint a = curve.evaluate(u);
      const CurvePoint b = reference.evaluate(u);
      // Derivatives against their own size: |R'| may be 1e6 times the polygon with such weights.
      const double width = 2.0 * curve.spans()[curve.locate(u).span].half;
      const double first = std::max(norm(b.first), size / width);
      const double second = std::max(norm(b.second), first / width);
      worst = std::max(worst, norm(a.position - b.position) / size);
      worst_first = std::max(worst_first, norm(a.first - b.first) / first);
      worst_second = std::max(worst_second, norm(a.second - b.second) / second);
    }
  }
  fmt::print("  position {:.2g}, first {:.2g}, second {:.2g} relative\n", worst, worst_first,
             worst_second);
  EXPECT_LT(worst, 1e-13);
  EXPECT_LT(worst_first, 1e-12);
  EXPECT_LT(worst_second, 1e-10);
}

TEST(Curve, DerivativesAreTheDifferencesOfPositions) {
  const ReferenceCurve curve(test::butterfly());
  for (const double u : {0.1, 0.31, 0.55, 0.9}) {
    const double h = 1e-5;
    const CurvePoint c = curve.evaluate(u);
    const Vec3 ahead = curve.evaluate(u + h).position;
    const Vec3 behind = curve.evaluate(u - h).position;
    EXPECT_LT(norm((0.5 / h) * (ahead - behind) - c.first), 1e-4 * norm(c.first));
    EXPECT_LT(norm((1.0 / (h * h)) * (ahead - 2.0 * c.position + behind) - c.second),
              1e-3 * norm(c.second));
  }
}

TEST(Curve, BezierIsTheSpecialCaseWithoutInteriorKnots) {
  CurveData data{3, bezier_knots(3), {{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 0}}, {}};
  const Curve curve(data);
  ASSERT_EQ(curve.spans().size(), 1U);
  const Vec3 middle = curve.position(0.5);  // (P0 + 3 P1 + 3 P2 + P3) / 8
  EXPECT_NEAR(middle.x, 2.0, 1e-15);
  EXPECT_NEAR(middle.y, 1.5, 1e-15);
  EXPECT_NEAR(middle.z, 0.375, 1e-15);
}

TEST(Curve, ARationalCircleIsRound) {
  const Curve curve(test::data_curve("circle", 2));
  for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(norm(curve.position(i * 1e-3)), 10.0, 1e-14);
  EXPECT_NEAR(curve.length(), 20.0 * std::acos(-1.0), 1e-12);
}

TEST(Curve, SpansFollowEachOtherWithoutGaps) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const CurveData data = test::random_curve(seed);
    const Curve curve(data);
    for (std::size_t k = 1; k < curve.spans().size(); ++k) {
      EXPECT_EQ(curve.spans()[k - 1].end, curve.spans()[k].begin);
      const Homogeneous left = curve.local({k - 1, 1.0}).position + curve.offset(k - 1, k);
      const Homogeneous right = curve.local({k, -1.0}).position;
      EXPECT_LT(norm((left - right).xyz()), 1e-13 * polygon_size(data)) << seed;
    }
  }
}

TEST(Curve, BendBoundsTheSecondDerivative) {
  double tightest = 0.0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const Curve curve(test::random_curve(seed));
    for (std::size_t k = 0; k < curve.spans().size(); ++k) {
      for (int i = 0; i <= 20; ++i) {
        const Cursor at{k, -1.0 + 0.1 * i};
        const double second = norm(curve.local_second(at, curve.local(at)));
        const double slack = 1e-11 * (1.0 + curve.spans()[k].bend);
        EXPECT_LE(second, curve.spans()[k].bend + slack) << seed;
        if (curve.spans()[k].bend > 0.0)
          tightest = std::max(tightest, second / curve.spans()[k].bend);
      }
    }
  }
  EXPECT_GT(tightest, 0.9);  // and it is not merely large
}

TEST(Curve, LocateFindsTheSpanFromAnyHint) {
  const Curve curve(test::butterfly());
  for (int i = 0; i <= 300; ++i) {
    const double u = i / 300.0;
    const Cursor plain = curve.locate(u);
    EXPECT_LE(curve.spans()[plain.span].begin, u);
    EXPECT_GE(curve.spans()[plain.span].end, u);
    for (std::size_t hint = 0; hint < curve.spans().size(); hint += 7) {
      EXPECT_EQ(curve.locate(u, hint).span, plain.span);
    }
  }
  EXPECT_EQ(curve.locate(-5.0).t, -1.0);
  EXPECT_EQ(curve.locate(5.0).t, 1.0);
}

TEST(ArcLength, MatchesClosedForms) {
  // A parabola (t, t^2), 0 <= t <= 1, and a cusp (t^2, t^3), -1 <= t <= 1, as Bezier curves.
  const Curve parabola(CurveData{2, bezier_knots(2), {{0, 0}, {0.5, 0}, {1, 1}}, {}});
  EXPECT_NEAR(parabola.length(), 0.5 * std::sqrt(5.0) + 0.25 * std::asinh(2.0), 1e-14);
  const Curve cusp(
      CurveData{3, bezier_knots(3), {{1, -1}, {-1.0 / 3, 1}, {-1.0 / 3, -1}, {1, 1}}, {}});
  EXPECT_NEAR(cusp.length(), 2.0 * (13.0 * std::sqrt(13.0) - 8.0) / 27.0, 1e-13);
}

TEST(ArcLength, AddsUp) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Curve curve(test::random_curve(seed));
    const double middle = curve.begin() + 0.37 * (curve.end() - curve.begin());
    const double sum =
        arc_length(curve, curve.begin(), middle) + arc_length(curve, middle, curve.end());
    EXPECT_NEAR(sum, curve.length(), 1e-11 * curve.length()) << seed;
  }
}

/// Chords of the reference curve share nothing with arc_length() but the data, and converge from
/// below.
TEST(ArcLength, IsTheLimitOfChordSums) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const CurveData data = test::random_curve(seed, {.weight_decades = 0.5});
    const ReferenceCurve reference(data);
    const auto chords = [&](int n) {
      double sum = 0.0;
      Vec3 before = reference.evaluate(reference.begin(), 0).position;
      for (int i = 1; i <= n; ++i) {
        const double u = reference.begin() + (reference.end() - reference.begin()) * i / n;
        const Vec3 here = reference.evaluate(u, 0).position;
        sum += norm(here - before);
        before = here;
      }
      return sum;
    };
    const double fine = chords(40000);
    const double length = Curve(data).length();
    EXPECT_GE(length, fine * (1.0 - 1e-10)) << seed;
    EXPECT_NEAR(length, fine, 2e-4 * length) << seed;
  }
}

struct BrokenCurve {
  const char* what;
  CurveData data;
  const char* line;
};

TEST(CurveFaults, EachHasItsLine) {
  const CurveData good = test::sun2008();
  const auto broken = [&](auto change) {
    CurveData data = good;
    change(data);
    return data;
  };
  const double nan = std::nan("");
  const std::vector<BrokenCurve> cases = {
      {"degree 0", broken([](CurveData& d) { d.degree = 0; }), "degree = 0"},
      {"degree 16", broken([](CurveData& d) { d.degree = 16; }), "degree = 16"},
      {"no points", broken([](CurveData& d) {
         d.points.clear();
         d.weights.clear();
       }),
       "too few"},
      {"knot count", broken([](CurveData& d) { d.knots.pop_back(); }), "13 knots must be 14"},
      {"weight count", broken([](CurveData& d) { d.weights.pop_back(); }), "10 weights for 11"},
      {"NaN point", broken([&](CurveData& d) { d.points[3].y = nan; }), "point 3"},
      {"huge point", broken([](CurveData& d) { d.points[3].x = 1e308; }), "point 3"},
      {"NaN knot", broken([&](CurveData& d) { d.knots[4] = nan; }), "knot 4"},
      {"falling knot", broken([](CurveData& d) { d.knots[5] = 0.1; }), "smaller than the one"},
      {"zero weight", broken([](CurveData& d) { d.weights[2] = 0.0; }), "weight 2 = 0"},
      {"infinite weight", broken([](CurveData& d) { d.weights[2] = HUGE_VAL; }), "weight 2"},
      {"weight ratio", broken([](CurveData& d) { d.weights[2] = 1e13; }), "ratio"},
      {"equal points", broken([](CurveData& d) {
         for (Vec3& p : d.points) p = {1, 1, 1};
       }),
       "all points are equal"},
      {"one knot", broken([](CurveData& d) {
         for (double& k : d.knots) k = 0.5;
       }),
       "more than degree + 1"},
      {"broken apart", broken([](CurveData& d) { d.knots[4] = d.knots[5] = d.knots[3]; }),
       "the curve breaks"},
      {"close knots", broken([](CurveData& d) { d.knots[4] = d.knots[3] + 1e-14; }), "closer than"},
      {"empty domain", {1, {0, 1, 1, 2}, {{0, 0}, {1, 1}}, {}}, "domain"},
  };
  for (const BrokenCurve& c : cases) {
    const std::vector<std::string> lines = faults(c.data);
    ASSERT_FALSE(lines.empty()) << c.what;
    EXPECT_NE(lines.front().find(c.line), std::string::npos) << c.what << ": " << lines.front();
    EXPECT_THROW(Curve curve(c.data), core::InputError) << c.what;
  }
  EXPECT_TRUE(faults(good).empty());
}

TEST(CurveFaults, AllAreReported) {
  CurveData data = test::sun2008();
  data.points[1].x = std::nan("");
  data.weights[2] = -1.0;
  data.knots[6] = 0.0;
  EXPECT_EQ(faults(data).size(), 3U);
}

TEST(CurveFaults, APointOnBothSidesOfAFullKnotIsNoBreak) {
  const CurveData data{1, {0, 0, 0.5, 0.5, 1, 1}, {{0, 0}, {1, 0}, {1, 0}, {1, 1}}, {}};
  EXPECT_TRUE(faults(data).empty());
  EXPECT_NEAR(Curve(data).length(), 2.0, 1e-15);
}

}  // namespace
}  // namespace millstudy::path
