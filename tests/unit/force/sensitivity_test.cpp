// SPDX-License-Identifier: MIT
#include "force/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/units.h"
#include "force/nonlinear_force.h"
#include "unit/force/random_cutters.h"

namespace millstudy::force {
namespace {

using testing::uniform;
using Vector = Sensitivity::Vector;

/// A cut and everything that a force is derived by.
struct Point {
  cutter::Cutter cutter;
  Engagement engagement;
  double angle;
  double feed;
  FittedCoefficients coefficients;
};

Variation variation_of(const FittedCoefficients& c) {
  Variation variation;
  HeightFactors factors;
  for (int q = 0; q < 6; ++q) factors.polynomial[q] = {c.k[6 + q] / c.k[q]};
  variation.height = std::make_shared<const HeightFactors>(factors);
  variation.size_exponent = {c.size_exponent, c.size_exponent, c.size_exponent};
  variation.reference_chip_thickness = c.reference_chip_thickness;
  return variation;
}

/// The force by the other kernel.
Vector reference_force(const Point& point) {
  const auto edges = std::make_shared<const CuttingEdges>(
      point.cutter, point.engagement.axial_depth, variation_of(point.coefficients));
  const NonlinearForce force(edges, {});
  const std::array<double, 12>& k = point.coefficients.k;
  Vector sum{};
  const Arc arc = point.engagement.arc();
  for (std::size_t j = 0; j < edges->flutes().size(); ++j) {
    const auto of_flute =
        force.of_flute(static_cast<int>(j), point.angle + edges->flutes()[j].position, {&arc, 1},
                       {k[0], k[1], k[2], k[3], k[4], k[5]}, {point.feed}, Rows::forces);
    for (int row = 0; row < 3; ++row) sum[row] += of_flute[row];
  }
  return sum;
}

Sensitivity at(const Point& point) {
  const bool size_effect = point.coefficients.size_exponent != 0.0;
  ForceSensitivity kernel(point.cutter, point.engagement, {true, size_effect});
  return kernel.at(point.angle, point.feed, point.coefficients);
}

/// Random cutter of any shape, equal or unequal flutes, cutting anywhere.
Point random_point(std::mt19937_64& random, bool with_size_effect) {
  for (;;) {
    const auto kind = static_cast<testing::Kind>(random() % 8);
    const reference::Cut cut = testing::random_cut(random, kind);
    Point point;
    point.cutter = cut.cutter;
    point.cutter.runout.tilt = 0.0;
    if (point.cutter.helix_angle == 0.0 && point.cutter.helix_angles.empty()) continue;
    point.engagement = {cut.arcs[0].entry_angle, cut.arcs[0].exit_angle, cut.axial_depth};
    point.feed = cut.feed.per_tooth;
    for (int q = 0; q < 6; ++q) {
      point.coefficients.k[q] = uniform(random, 0.2, 1.0) * (q < 3 ? 2000.0 : 30.0);
      point.coefficients.k[6 + q] =
          uniform(random, -0.3, 0.3) * point.coefficients.k[q] / cut.axial_depth;
    }
    if (with_size_effect) {
      point.coefficients.size_exponent = uniform(random, 0.05, 0.4);
      point.coefficients.reference_chip_thickness = uniform(random, 0.05, 0.2);
    }
    point.angle = uniform(random, -7.0, 7.0);
    if (reference_force(point) != Vector{}) return point;
  }
}

double size(const Vector& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

/// How far a derivative is from central differences of the other kernel, of steps that suit it.
///
/// @param scale  of the variable: a step of it changes the force by about the force
double off(const Point& point, const Vector& derivative, double scale,
           const std::function<void(Point&, double)>& move) {
  double best = std::numeric_limits<double>::infinity();
  for (const double part : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const double step = part * scale;
    const auto moved = [&](double by) {
      Point other = point;
      move(other, by);
      return reference_force(other);
    };
    const Vector a = moved(step), b = moved(-step), c = moved(2 * step), d = moved(-2 * step),
                 e = moved(3 * step), f = moved(-3 * step);
    Vector wrong;
    for (int row = 0; row < 3; ++row) {
      const double difference =
          (45.0 * (a[row] - b[row]) - 9.0 * (c[row] - d[row]) + (e[row] - f[row])) / (60.0 * step);
      wrong[row] = difference - derivative[row];
    }
    best = std::min(best, size(wrong));
  }
  return best / (size(derivative) + size(reference_force(point)) / scale);
}

void expect_derivatives(std::mt19937_64& random, bool with_size_effect, int count) {
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const Point point = random_point(random, with_size_effect);
    const Sensitivity s = at(point);
    const auto with_offset = [](Point& p, double dx, double dy) {
      cutter::Runout& runout = p.cutter.runout;
      const double x = runout.offset * std::cos(runout.angle) + dx;
      const double y = runout.offset * std::sin(runout.angle) + dy;
      runout.offset = std::hypot(x, y);
      runout.angle = std::atan2(y, x);
    };
    const double length = std::max(point.feed, point.cutter.runout.offset);
    // Of an edge that enters at an angle without chip, half of all runouts take the edge force away
    // at once: without runout there is no derivative.
    const bool runs_out = point.cutter.runout.offset > 0.0;
    const std::array<double, 5> all = {
        off(point, s.angle, 0.1, [](Point& p, double by) { p.angle += by; }),
        off(point, s.feed, length, [](Point& p, double by) { p.feed += by; }),
        !runs_out ? 0.0
                  : off(point, s.runout[0], length,
                        [&](Point& p, double by) { with_offset(p, by, 0.0); }),
        !runs_out ? 0.0
                  : off(point, s.runout[1], length,
                        [&](Point& p, double by) { with_offset(p, 0.0, by); }),
        with_size_effect ? off(point, s.exponent, 0.1,
                               [](Point& p, double by) { p.coefficients.size_exponent += by; })
                         : 0.0};
    for (std::size_t q = 0; q < all.size(); ++q) {
      EXPECT_LT(all[q], 1e-7) << "derivative " << q << " of point " << i;
      worst = std::max(worst, all[q]);
    }
  }
  std::printf("worst derivative of %d points: %.1e\n", count, worst);
}

TEST(ForceSensitivity, HasTheForceOfTheOtherKernel) {
  std::mt19937_64 random(11);
  double worst = 0.0;
  for (int i = 0; i < 400; ++i) {
    const Point point = random_point(random, i % 2 == 0);
    const Vector force = at(point).force, reference = reference_force(point);
    Vector wrong;
    for (int row = 0; row < 3; ++row) wrong[row] = force[row] - reference[row];
    worst = std::max(worst, size(wrong) / size(reference));
  }
  std::printf("worst force: %.1e\n", worst);
  EXPECT_LT(worst, 1e-12);
}

// Engaged from entry to exit of a slot, a tooth has no chip of its own at both ends; without helix
// there is but one lag; without feed only runout makes chips.
TEST(ForceSensitivity, HasTheForceOfTheOtherKernelWhereLinesVanish) {
  const auto with_runout = [](cutter::Cutter cutter, double offset, double angle) {
    cutter.runout.offset = offset;
    cutter.runout.angle = angle;
    return cutter;
  };
  cutter::Cutter needle{cutter::Shape::taper, 2.0, 2, core::kTurn / 8.0};
  needle.taper_angle = core::kTurn / 120.0;
  needle.lead = cutter::Lead::constant_helix;
  cutter::Cutter left = needle;
  left.flutes = 3;
  left.helix_angle = -left.helix_angle;
  const cutter::Cutter steep{cutter::Shape::flat, 6.0, 4, core::kTurn / 8.0};
  const cutter::Cutter straight{cutter::Shape::flat, 10.0, 3, 0.0};
  struct Case {
    cutter::Cutter cutter;
    double depth, feed;
  };
  double worst = 0.0;
  for (const Case& one : {Case{with_runout(needle, 0.03, 0.4), 30.0, 0.02},
                          {with_runout(needle, 0.005, 2.0), 30.0, 0.02},
                          {with_runout(left, 0.03, 1.0), 22.0, 0.02},
                          {with_runout(steep, 0.03, 0.0), 20.0, 0.05},
                          {with_runout(steep, 0.2, 0.0), 20.0, 0.05},
                          {with_runout(steep, 0.01, 1.0), 20.0, 0.0},
                          {with_runout(straight, 0.02, 0.5), 2.0, 0.05}}) {
    Point point{one.cutter, slot(one.depth), 0.0, one.feed, {}};
    point.coefficients.k = {700.0, 300.0, 170.0, 15.0, 19.0, 18.0};
    std::vector<Vector> wrong;
    double peak = 0.0;
    for (int i = 0; i < 1500; ++i) {
      point.angle = core::kTurn * i / 1500.0;
      const Vector reference = reference_force(point);
      for (const bool slopes : {false, true}) {
        ForceSensitivity kernel(point.cutter, point.engagement, {slopes, false});
        const Vector force = kernel.at(point.angle, point.feed, point.coefficients).force;
        wrong.push_back({});
        for (int row = 0; row < 3; ++row) wrong.back()[row] = force[row] - reference[row];
      }
      peak = std::max(peak, size(reference));
    }
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      EXPECT_LE(size(wrong[i]), 1e-12 * peak) << "angle " << i / 2 << ", depth " << one.depth;
      worst = std::max(worst, size(wrong[i]) / peak);
    }
  }
  std::printf("worst force: %.1e of the peak\n", worst);
}

TEST(ForceSensitivity, IsTheDerivativeOfTheForce) {
  std::mt19937_64 random(12);
  expect_derivatives(random, false, 100);
}

TEST(ForceSensitivity, IsTheDerivativeOfTheForceWithASizeEffect) {
  std::mt19937_64 random(13);
  expect_derivatives(random, true, 100);
}

TEST(ForceSensitivity, IsLinearInTheCoefficients) {
  std::mt19937_64 random(14);
  for (int i = 0; i < 100; ++i) {
    const Point point = random_point(random, i % 2 == 0);
    const Sensitivity s = at(point);
    for (int row = 0; row < 3; ++row) {
      double sum = 0.0, terms = 0.0;
      for (int q = 0; q < kFittedColumns; ++q) {
        sum += s.coefficient[q][row] * point.coefficients.k[q];
        terms += std::abs(s.coefficient[q][row] * point.coefficients.k[q]);
      }
      EXPECT_NEAR(s.force[row], sum, 1e-13 * terms);
    }
  }
}

TEST(ForceSensitivity, RefusesTiltedAxes) {
  cutter::Cutter cutter = testing::haber_cutter(cutter::Shape::flat);
  cutter.runout.tilt = 1e-3;
  EXPECT_THROW(ForceSensitivity(cutter, slot(1.0), {}), core::InputError);
}

}  // namespace
}  // namespace millstudy::force
