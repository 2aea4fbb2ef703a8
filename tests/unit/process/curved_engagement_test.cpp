// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "core/error.h"
#include "paths.h"
#include "process/immersion.h"
#include "process/path_engagement.h"

namespace millstudy::process {
namespace {

using Side = Immersion::Side;
using testing::circle;
using testing::corner;
using testing::direction;
using testing::straight;
using testing::uniform;

constexpr double kRadius = 6.0;

force::Engagement on_straight_path(double radius, const Immersion& immersion) {
  if (immersion.side == Side::constant) return force::slot(1.0);
  return immersion.side == Side::up ? force::up_milling(radius, immersion.radial_depth, 1.0)
                                    : force::down_milling(radius, immersion.radial_depth, 1.0);
}

Machining machining_of(double radius, const Immersion& immersion) {
  Machining machining;
  machining.cutter = {cutter::Shape::flat, 2.0 * radius, 2, core::rad_from_deg(30.0)};
  machining.engagement = on_straight_path(radius, immersion);
  machining.immersion = immersion;
  return machining;
}

std::vector<ArcSet> arcs_along(const path::Interpolation& path, const Machining& machining) {
  const PathEngagement engagement(path, machining);
  std::vector<ArcSet> all;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    all.push_back(engagement.arcs(i, direction(path, i)));
  }
  return all;
}

bool contains(const ArcSet& set, double phi) {
  return std::ranges::any_of(set.arcs(), [&](const force::Arc& arc) {
    return arc.entry_angle <= phi && phi <= arc.exit_angle;
  });
}

double width(const ArcSet& set) {
  double sum = 0.0;
  for (const force::Arc& arc : set.arcs()) sum += arc.exit_angle - arc.entry_angle;
  return sum;
}

/// How the raw surface lies: a polygon, with the material inside or outside.
struct RawSurface {
  std::vector<path::Vec3> corners;
  bool material_inside;

  bool has(const path::Vec3& p) const {
    bool inside = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      const path::Vec3& a = corners[i];
      const path::Vec3& b = corners[j];
      if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
        inside = !inside;
      }
    }
    return inside == material_inside;
  }

  double distance(const path::Vec3& p) const {
    double least = 1e300;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      const path::Vec3 edge = corners[i] - corners[j];
      const path::Vec3 way = p - corners[j];
      const double t = std::clamp(path::dot(way, edge) / path::dot(edge, edge), 0.0, 1.0);
      least = std::min(least, path::norm(way - t * edge));
    }
    return least;
  }
};

/// The path moved sideways, to where the cutter's own outside would leave ae uncut.
RawSurface surface_beside_circle(const path::Interpolation& path, double radius,
                                 const Immersion& immersion, double curvature) {
  const double left = (immersion.side == Side::up ? 1.0 : -1.0) * (radius - immersion.radial_depth);
  RawSurface surface;
  surface.material_inside = (immersion.side == Side::up) == (curvature > 0.0);
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const double theta = direction(path, i);
    const path::Vec3 middle = 0.5 * (path.points[i] + path.points[i + 1]);
    surface.corners.push_back(middle + left * path::Vec3{-std::sin(theta), std::cos(theta), 0.0});
  }
  return surface;
}

TEST(CurvedEngagement, IsWhatThePolygonOfTheStockSays) {
  std::mt19937_64 random(7);
  int checked = 0;
  for (unsigned n = 0; n < testing::random_count(300); ++n) {
    const double radius = uniform(random, 1.0, 12.0);
    const Immersion immersion{random() % 2 ? Side::up : Side::down,
                              2.0 * radius * uniform(random, 0.001, 0.999)};
    const double path_radius = radius * std::pow(10.0, uniform(random, -0.2, 1.5));
    const double curvature = (random() % 2 ? 1.0 : -1.0) / path_radius;
    // Beyond its own centre a parallel to a circle is none.
    const double left = immersion.side == Side::up ? radius - immersion.radial_depth
                                                   : immersion.radial_depth - radius;
    if (1.0 - left * curvature <= 0.0) continue;
    constexpr int kPeriods = 1000;
    const double chord = 2.0 * path_radius * std::sin(core::kPi / kPeriods);
    const path::Interpolation path = circle(kPeriods, chord, curvature, uniform(random, -3.0, 3.0));
    const RawSurface surface = surface_beside_circle(path, radius, immersion, curvature);
    const PathEngagement engagement(path, machining_of(radius, immersion));
    const auto i = static_cast<std::int64_t>(random() % kPeriods);
    const ArcSet arcs = engagement.arcs(i, direction(path, i));
    const double sagitta = 1e-4 * path_radius;  // of the polygon, with much to spare
    for (int m = 0; m < 200; ++m) {
      const double phi = core::kPi * (m + 0.5) / 200;
      const path::Vec3 point = testing::on_tool(path, i, radius, phi);
      if (surface.distance(point) < sagitta) continue;
      ++checked;
      ASSERT_EQ(contains(arcs, phi), surface.has(point))
          << "R=" << radius << " ae=" << immersion.radial_depth << " k=" << curvature
          << (immersion.side == Side::up ? " up" : " down") << " phi=" << phi;
    }
  }
  EXPECT_GT(checked, 40'000);
}

TEST(CurvedEngagement, OnAStraightPathIsTheConstantOneToTheBit) {
  std::mt19937_64 random(3);
  for (const Side side : {Side::up, Side::down}) {
    for (unsigned n = 0; n < testing::random_count(100); ++n) {
      const Machining machining =
          machining_of(kRadius, {side, kRadius * uniform(random, 0.001, 2.0)});
      const path::Interpolation path = straight(100, 0.058, uniform(random, -4.0, 4.0));
      for (const ArcSet& arcs : arcs_along(path, machining)) {
        ASSERT_EQ(arcs, ArcSet(machining.engagement.arc()));
      }
    }
  }
}

TEST(CurvedEngagement, OfAConcaveWallIsWiderThanOfAStraightOne) {
  // The path turns away from the wall: right of a wall on the left.
  for (const Side side : {Side::up, Side::down}) {
    const Machining machining = machining_of(kRadius, {side, 2.0});
    const double away = side == Side::up ? -0.05 : 0.05;
    const double straight_width = width(ArcSet(machining.engagement.arc()));
    for (const ArcSet& arcs : arcs_along(circle(500, 0.06, away, 0.3), machining)) {
      EXPECT_GT(width(arcs), straight_width + 0.05);
    }
    for (const ArcSet& arcs : arcs_along(circle(500, 0.06, -away, 0.3), machining)) {
      EXPECT_LT(width(arcs), straight_width - 0.05);
    }
  }
}

TEST(CurvedEngagement, OfAWholeCircleIsTheSameAllAround) {
  for (const double curvature : {0.03, -0.03}) {
    const Machining machining = machining_of(kRadius, {Side::up, 2.0});
    const path::Interpolation path = circle(3490, 0.06, curvature, 0.3);
    const double exit = std::acos(1.0 - 2.0 / kRadius * (1.0 - curvature * (kRadius - 1.0)));
    for (const ArcSet& arcs : arcs_along(path, machining)) {
      ASSERT_EQ(arcs.arcs().size(), 1u);
      ASSERT_EQ(arcs.arcs()[0].entry_angle, 0.0);
      ASSERT_NEAR(arcs.arcs()[0].exit_angle, exit, 1e-9);
    }
  }
}

TEST(CurvedEngagement, OfTheReversedPathIsMirrored) {
  const auto wave = [](double s) { return path::Vec3{s, 5.0 * std::sin(0.1 * s), 0.0}; };
  std::vector<path::Vec3> points;
  for (int i = 0; i <= 2000; ++i) points.push_back(wave(0.06 * i));
  const path::Interpolation path = testing::path_of(points);
  const auto up = arcs_along(path, machining_of(kRadius, {Side::up, 2.0}));
  const auto down = arcs_along(testing::reversed(path), machining_of(kRadius, {Side::down, 2.0}));
  // Away from the ends, and where the reach ahead and behind hold the same.
  for (std::size_t i = 400; i < 1600; ++i) {
    const force::Arc& a = up[i].arcs()[0];
    const force::Arc& b = down[1999 - i].arcs()[0];
    ASSERT_NEAR(a.exit_angle, core::kPi - b.entry_angle, 1e-9) << i;
    ASSERT_EQ(b.exit_angle, core::kPi);
  }
}

TEST(CurvedEngagement, RemovesTheAreaOfTheRing) {
  std::mt19937_64 random(11);
  for (unsigned n = 0; n < testing::random_count(300); ++n) {
    const double radius = uniform(random, 1.0, 12.0);
    const Immersion immersion{Side::up, radius * uniform(random, 0.01, 1.9)};
    const double curvature = uniform(random, -1.0, 1.0) / radius;
    const double depth = immersion.radial_depth;
    const double wall = 1.0 / curvature - radius;  // radius of the wall, negative if concave
    const double ring = 0.5 * std::abs((wall + depth) * (wall + depth) - wall * wall);
    const double area = ring * std::abs(curvature);  // per length of the path
    const ArcSet arcs = immersed_arc(radius, immersion, {curvature, 100.0});
    const double equivalent = equivalent_radial_depth(radius, immersion, curvature);
    if (equivalent <= 0.0 || equivalent >= 2.0 * radius) continue;
    const force::Arc& arc = arcs.arcs()[0];
    EXPECT_NEAR(radius * (std::cos(arc.entry_angle) - std::cos(arc.exit_angle)), area,
                1e-12 * radius);
    EXPECT_NEAR(equivalent, area, 1e-12 * radius);
  }
}

TEST(CurvedEngagement, FollowsTheWallOfAWave) {
  // The raw surface along a path of varying curvature: what the circle that fits there leaves out.
  std::vector<path::Vec3> points, surface;
  for (int i = 0; i <= 4000; ++i) {
    const double s = 0.05 * i - 100.0;
    points.push_back({s, 4.0 * std::sin(0.1 * s), 0.0});
  }
  const path::Interpolation path = testing::path_of(points);
  for (std::int64_t i = 0; i < 4000; ++i) {
    const double theta = direction(path, i);
    surface.push_back(0.5 * (points[i] + points[i + 1]) +
                      (kRadius - 2.0) * path::Vec3{-std::sin(theta), std::cos(theta), 0.0});
  }
  surface.push_back({100.0, 50.0, 0.0});
  surface.push_back({-100.0, 50.0, 0.0});
  const RawSurface stock{surface, true};
  const Machining machining = machining_of(kRadius, {Side::up, 2.0});
  const double straight_exit = machining.engagement.exit_angle;
  const PathEngagement engagement(path, machining);
  double largest = 0.0, of_constant = 0.0;
  for (std::int64_t i = 1000; i < 3000; i += 10) {
    double in = 0.0, out = core::kPi;
    while (out - in > 1e-6) {
      const double phi = 0.5 * (in + out);
      (stock.has(testing::on_tool(path, i, kRadius, phi)) ? in : out) = phi;
    }
    const double exit = engagement.arcs(i, direction(path, i)).arcs()[0].exit_angle;
    largest = std::max(largest, std::abs(exit - in));
    of_constant = std::max(of_constant, std::abs(straight_exit - in));
  }
  EXPECT_GT(of_constant, 0.09);
  EXPECT_LT(largest, 0.012);
}

TEST(CurvedEngagement, EndsWithNoCutAndWithHalfATurn) {
  const Bend sharp{1.0, 10.0};
  EXPECT_TRUE(immersed_arc(kRadius, {Side::up, 2.0}, sharp).empty());
  EXPECT_EQ(immersed_arc(kRadius, {Side::down, 2.0}, sharp), ArcSet(force::Arc{0.0, core::kPi}));
  EXPECT_EQ(immersed_arc(kRadius, {Side::up, 2.0}, {-1.0, 10.0}),
            ArcSet(force::Arc{0.0, core::kPi}));
  EXPECT_TRUE(immersed_arc(kRadius, {Side::down, 2.0}, {-1.0, 10.0}).empty());
}

TEST(CurvedEngagement, OfAFullWidthCutIsAlwaysTheSame) {
  for (const double curvature : {-0.3, -0.01, 0.02, 0.4}) {
    EXPECT_EQ(immersed_arc(kRadius, {Side::up, 2.0 * kRadius}, {curvature, 10.0}),
              ArcSet(force::Arc{0.0, core::kPi}));
  }
}

TEST(CurvedEngagement, AtACornerIsTheStraightOneTurned) {
  const Immersion immersion{Side::up, 2.0};
  const Machining machining = machining_of(kRadius, immersion);
  const double before = machining.engagement.exit_angle;
  for (const double turn : {-0.1, -1.0, -2.5, 0.1, 0.6, 2.5}) {  // right into the wall, left off it
    const auto arcs = arcs_along(corner(500, 0.06, turn), machining);
    const double at_corner = std::clamp(before - turn, 0.0, core::kPi);
    EXPECT_NEAR(width(arcs[499]), at_corner, 1e-9) << turn;
    for (const std::size_t i : {0, 498, 500, 501, 999}) {
      EXPECT_EQ(arcs[i], ArcSet(machining.engagement.arc())) << turn << " at " << i;
    }
  }
}

TEST(CurvedEngagement, RefusesARadialDepthBeyondTheCutter) {
  const path::Interpolation path = straight(3, 0.06, 0.0);
  for (const double depth : {0.0, -1.0, 12.1, std::nan("")}) {
    Machining machining = machining_of(kRadius, {Side::up, 2.0});
    machining.immersion.radial_depth = depth;
    EXPECT_THROW(PathEngagement(path, machining), core::InputError);
  }
}

}  // namespace
}  // namespace millstudy::process
