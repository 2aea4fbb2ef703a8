// SPDX-License-Identifier: MIT
#include "process/stock.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "paths.h"

namespace millstudy::process {
namespace {

using testing::circle;
using testing::direction;
using testing::straight;
using testing::uniform;

constexpr double kRadius = 6.0;
const ArcSet kHalfTurn(force::Arc{0.0, core::kPi});

bool contains(const ArcSet& set, double phi) {
  return std::ranges::any_of(set.arcs(), [&](const force::Arc& arc) {
    return arc.entry_angle <= phi && phi <= arc.exit_angle;
  });
}

TEST(WithinCap, KeepsWhatTheSineSays) {
  std::mt19937_64 random(5);
  for (unsigned n = 0; n < testing::random_count(3000); ++n) {
    const double a = uniform(random, 0.0, core::kPi), b = uniform(random, 0.0, core::kPi);
    const ArcSet set(force::Arc{std::min(a, b), std::max(a, b)});
    const double first = uniform(random, -9.0, 9.0), second = uniform(random, -9.0, 9.0);
    const double least = uniform(random, -1.1, 1.1), other = uniform(random, -1.1, 0.1);
    const ArcSet once = within_cap(set, first, least);
    const ArcSet twice = within_cap(once, second, other);
    ASSERT_LE(once.arcs().size(), 2u);
    ASSERT_LE(twice.arcs().size(), 3u);
    double last = 0.0;
    for (const force::Arc& arc : twice.arcs()) {
      ASSERT_LE(last, arc.entry_angle);
      ASSERT_LT(arc.entry_angle, arc.exit_angle);
      ASSERT_LE(arc.exit_angle, core::kPi);
      last = arc.exit_angle;
    }
    for (int m = 0; m < 300; ++m) {
      const double phi = core::kPi * (m + 0.5) / 300;
      const double one = std::sin(phi - first) - least, two = std::sin(phi - second) - other;
      if (std::min(std::abs(one), std::abs(two)) < 1e-12) continue;
      ASSERT_EQ(contains(twice, phi), contains(set, phi) && one > 0.0 && two > 0.0);
    }
  }
}

TEST(WithinCap, CanLeaveThreeArcs) {
  const ArcSet once = within_cap(kHalfTurn, core::kPi, -0.9);
  ASSERT_EQ(once.arcs().size(), 2u);
  EXPECT_EQ(within_cap(once, core::kPi + 1.0, -0.9).arcs().size(), 3u);
}

TEST(StockEnds, BeginOneRadiusAheadOfTheStart) {
  const path::Interpolation path = straight(400, 0.06, 0.7);
  const StockEnds ends(path, kRadius, Stock::entry);
  for (int i = 0; i < 400; ++i) {
    const ArcSet arcs = ends.within(kHalfTurn, i, 0.7);
    const double way = (i + 0.5) * 0.06;
    ASSERT_EQ(arcs.arcs().size(), 1u);
    const double half = way < kRadius ? std::acos(1.0 - way / kRadius) : 0.5 * core::kPi;
    EXPECT_NEAR(arcs.arcs()[0].entry_angle, 0.5 * core::kPi - half, 1e-9);
    EXPECT_NEAR(arcs.arcs()[0].exit_angle, 0.5 * core::kPi + half, 1e-9);
  }
  EXPECT_EQ(ends.within(kHalfTurn, 100, 0.7), kHalfTurn);  // to the bit
}

TEST(StockEnds, LeaveTwoArcsOnTheWayOut) {
  const path::Interpolation path = straight(400, 0.06, -0.4);
  const StockEnds ends(path, kRadius, Stock::exit);
  EXPECT_EQ(ends.within(kHalfTurn, 0, -0.4), kHalfTurn);
  EXPECT_EQ(ends.within(kHalfTurn, 299, -0.4), kHalfTurn);
  for (int i = 300; i < 400; ++i) {
    const ArcSet arcs = ends.within(kHalfTurn, i, -0.4);
    const double left = (400 - i - 0.5) * 0.06;
    ASSERT_EQ(arcs.arcs().size(), 2u);
    EXPECT_NEAR(arcs.arcs()[0].exit_angle, std::asin(left / kRadius), 1e-9);
    EXPECT_NEAR(arcs.arcs()[1].entry_angle, core::kPi - std::asin(left / kRadius), 1e-9);
  }
}

/// Entry and exit on a path of any curvature, against where the points of the tool lie.
TEST(StockEnds, AreWhereTheToolIsInside) {
  std::mt19937_64 random(17);
  for (unsigned n = 0; n < testing::random_count(100); ++n) {
    const double curvature = uniform(random, -0.2, 0.2);
    const path::Interpolation path = circle(300, 0.06, curvature, uniform(random, -3.0, 3.0));
    const double radius = uniform(random, 1.0, 8.0);
    const double start = direction(path, 0), end = direction(path, 299);
    const StockEnds ends(path, radius, Stock::both);
    const auto inside_start = [&](const path::Vec3& p) {
      return (p.x - path.points[0].x) * std::cos(start) +
             (p.y - path.points[0].y) * std::sin(start) - radius;
    };
    const auto inside_end = [&](const path::Vec3& p) {
      return (path.points[300].x - p.x) * std::cos(end) +
             (path.points[300].y - p.y) * std::sin(end);
    };
    const auto least = [&](std::int64_t i, const auto& inside) {
      double smallest = 1e300;
      for (int m = 0; m <= 2000; ++m) {
        smallest =
            std::min(smallest, inside(testing::on_tool(path, i, radius, core::kPi * m / 2000)));
      }
      return smallest;
    };
    int entered = 0, leaving = 300;
    while (entered < 300 && least(entered, inside_start) < 0.0) ++entered;
    while (leaving > 0 && least(leaving - 1, inside_end) < 0.0) --leaving;
    for (int i = 0; i < 300; i += 3) {
      const ArcSet arcs = ends.within(kHalfTurn, i, direction(path, i));
      for (int m = 0; m < 200; ++m) {
        const double phi = core::kPi * (m + 0.5) / 200;
        const path::Vec3 p = testing::on_tool(path, i, radius, phi);
        const double from = i < entered ? inside_start(p) : 1.0;
        const double to = i >= leaving ? inside_end(p) : 1.0;
        if (std::min(std::abs(from), std::abs(to)) < 1e-5) continue;  // the scan's own resolution
        ASSERT_EQ(contains(arcs, phi), from > 0.0 && to > 0.0) << n << " " << i << " " << phi;
      }
    }
  }
}

TEST(StockEnds, DoNotCutAClosedPathTwice) {
  // One turn and a half: past the start again, which is past the face of the entry.
  const double curvature = 0.04;
  const double chord = 2.0 * std::sin(core::kPi / 2000) / curvature;
  const path::Interpolation path = circle(3000, chord, curvature, 0.2);
  const StockEnds ends(path, kRadius, Stock::entry);
  EXPECT_NE(ends.within(kHalfTurn, 0, direction(path, 0)), kHalfTurn);
  for (int i = 500; i < 3000; ++i) {
    ASSERT_EQ(ends.within(kHalfTurn, i, direction(path, i)), kHalfTurn) << i;
  }
  const path::Interpolation once = circle(2000, chord, curvature, 0.2);
  const StockEnds both(once, kRadius, Stock::both);
  for (int i = 500; i < 1500; ++i) {
    ASSERT_EQ(both.within(kHalfTurn, i, direction(once, i)), kHalfTurn) << i;
  }
  EXPECT_LT(both.within(kHalfTurn, 1999, direction(once, 1999)).arcs()[0].exit_angle, 0.1);
}

TEST(StockEnds, DoNotFollowAPartialStepAstray) {
  path::Interpolation path = straight(400, 0.06, 0.0);
  path.points.push_back(path.points.back() + path::Vec3{1e-11, 1e-11, 0.0});
  const StockEnds ends(path, kRadius, Stock::exit);
  const ArcSet arcs = ends.within(kHalfTurn, 380, 0.0);
  ASSERT_EQ(arcs.arcs().size(), 2u);
  EXPECT_NEAR(arcs.arcs()[0].exit_angle, core::kPi - arcs.arcs()[1].entry_angle, 1e-9);
}

}  // namespace
}  // namespace millstudy::process
