// SPDX-License-Identifier: MIT
#include "force/force_basis.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

#include "unit/force/cases.h"

namespace millstudy::force {
namespace {

using testing::Case;
using testing::distance;
using testing::exact_force;
using testing::Force;
using testing::peak_force;
using testing::random_case;
using testing::uniform;

cutter::Shape shape_of(int round) {
  return round % 2 ? cutter::Shape::ball : cutter::Shape::flat;
}

/// Away from where a tooth enters or leaves: at zero helix the force jumps there.
double quiet_angle(std::mt19937_64& random) {
  return uniform(random, -20.0, 20.0);
}

TEST(EdgeForce, RepeatsEveryToothPeriod) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 400; ++round) {
    const Case c = random_case(random, shape_of(round));
    const double phi = quiet_angle(random);
    const double later = phi + cutter::pitch_angle(c.cutter);
    // Adding the pitch rounds the angle; what that does to the force is not the law's fault.
    const double rounding = distance(exact_force(c, phi - 1e-14), exact_force(c, phi + 1e-14),
                                     cutter::radius(c.cutter));
    EXPECT_LE(distance(exact_force(c, phi), exact_force(c, later), cutter::radius(c.cutter)),
              rounding + 1e-13 * peak_force(c))
        << c;
  }
}

TEST(EdgeForce, IsLinearInCoefficientsAndFeed) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 200; ++round) {
    const Case c = random_case(random, shape_of(round));
    const ForceBasis basis = force_basis(c.cutter, c.engagement, {}, uniform(random, 0.0, 7.0));
    const auto coefficient = [&] { return uniform(random, -3.0, 3.0); };
    const Coefficients a{coefficient(), coefficient(), coefficient(),
                         coefficient(), coefficient(), coefficient()};
    const Coefficients b{coefficient(), coefficient(), coefficient(),
                         coefficient(), coefficient(), coefficient()};
    const Coefficients sum{a.Ktc + b.Ktc, a.Krc + b.Krc, a.Kac + b.Kac,
                           a.Kte + b.Kte, a.Kre + b.Kre, a.Kae + b.Kae};
    const Coefficients chip_twice{2 * a.Ktc, 2 * a.Krc, 2 * a.Kac, a.Kte, a.Kre, a.Kae};
    const Force fa = evaluate(basis, a, {0.1}), fb = evaluate(basis, b, {0.1});
    const Force together = evaluate(basis, sum, {0.1});
    const Force fed_twice = evaluate(basis, a, {0.2});
    const Force loaded_twice = evaluate(basis, chip_twice, {0.1});
    for (int row = 0; row < kRows; ++row) {
      const double scale = 1.0 + std::abs(fa[row]) + std::abs(fb[row]) +
                           c.engagement.axial_depth * c.cutter.diameter * 100.0;
      EXPECT_NEAR(together[row], fa[row] + fb[row], 1e-14 * scale);
      EXPECT_NEAR(fed_twice[row], loaded_twice[row], 1e-14 * scale);
    }
  }
}

TEST(EdgeForce, IsZeroOutOfCutAndNowhereElse) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 200; ++round) {
    Case c = random_case(random, shape_of(round));
    c.cutter.flutes = 1;
    const double lag = cutter::lag_rate(c.cutter) * c.engagement.axial_depth;
    if (std::abs(lag) > 2.5) continue;
    // The tip angles at which any of the edge is in cut.
    const double from = c.engagement.entry_angle + std::min(0.0, lag);
    const double to = c.engagement.exit_angle + std::max(0.0, lag);
    const double out = uniform(random, to + 1e-9, from + 2.0 * core::kPi - 1e-9);
    const double in = uniform(random, from + 1e-6 * (to - from), to - 1e-6 * (to - from));
    for (const EdgeRule& rule : {EdgeRule{}, EdgeRule{Rule::discs, 20}}) {
      const ForceBasis idle = force_basis(c.cutter, c.engagement, rule, out);
      EXPECT_EQ(distance(evaluate(idle, c.coefficients, {0.1}), Force{}, 1.0), 0.0) << c << out;
    }
    EXPECT_GT(distance(exact_force(c, in), Force{}, 1.0), 0.0) << c << in;
  }
}

/// Reflecting x turns a right-hand cutter into a left-hand one, phi into pi - phi, and swaps entry
/// and exit; it reverses Fx of radial and axial loads no more than it reverses Fy of tangential.
TEST(EdgeForce, OfALeftHandCutterIsTheMirrorImageOfTheRightHandOne) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 400; ++round) {
    const Case c = random_case(random, shape_of(round));
    cutter::Cutter mirrored = c.cutter;
    mirrored.helix_angle = -mirrored.helix_angle;
    const Engagement engagement{core::kPi - c.engagement.exit_angle,
                                core::kPi - c.engagement.entry_angle, c.engagement.axial_depth};
    const double phi = quiet_angle(random);
    const ForceBasis one = force_basis(c.cutter, c.engagement, {}, phi);
    const ForceBasis other = force_basis(mirrored, engagement, {}, core::kPi - phi);
    const ForceBasis near = force_basis(c.cutter, c.engagement, {}, phi + 1e-14);
    const double scale = c.engagement.axial_depth + c.cutter.diameter;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const bool flips = (row == 0 && column == 0) || (row == 1 && column != 0);
        const double sign = flips ? -1.0 : 1.0;
        const double unit = scale * (row == 3 ? c.cutter.diameter : 1.0);
        const double rounding = std::abs(near.edge[row][column] - one.edge[row][column]) +
                                std::abs(near.chip[row][column] - one.chip[row][column]);
        EXPECT_NEAR(other.chip[row][column], sign * one.chip[row][column], 1e-13 * unit + rounding);
        EXPECT_NEAR(other.edge[row][column], sign * one.edge[row][column], 1e-13 * unit + rounding);
      }
    }
  }
}

/// (x - sin(x) cos(x)) / 2 = (y - sin(y)) / 4 with y = 2 x, by its series where digits would go.
double half_x_minus_sin_cos(double x) {
  const double y = 2.0 * x;
  if (y > 0.5) return 0.25 * (y - std::sin(y));
  double sum = 0.0;
  double term = y * y * y / 6.0;
  for (int m = 4; m < 20; m += 2) {
    sum += term;
    term *= -y * y / (m * (m + 1.0));
  }
  return 0.25 * sum;
}

/// Without helix a tooth of a ball stands at one immersion angle, and its integrals over kappa are
/// elementary (theory.md, F10): the closed form that a small depth tends to.
ForceBasis ball_without_helix(double radius, double depth, double phi) {
  const double kappa = 2.0 * std::asin(std::sqrt(0.5 * depth / radius));
  const double s = std::sin(phi), c = std::cos(phi), sk = std::sin(kappa);
  const double sin_dz = radius * half_x_minus_sin_cos(kappa);
  const double cos_dz = 0.5 * radius * sk * sk;
  const double length = radius * kappa, cos_ds = radius * sk;  // and sin(kappa) dS gives depth
  ForceBasis basis;
  basis.chip = {{{-s * c * depth, -s * s * sin_dz, -s * s * cos_dz},
                 {s * s * depth, -s * c * sin_dz, -s * c * cos_dz},
                 {0.0, s * cos_dz, -s * sin_dz},
                 {s * radius * sin_dz, 0.0, 0.0}}};
  basis.edge = {{{-c * length, -s * depth, -s * cos_ds},
                 {s * length, -c * depth, -c * cos_ds},
                 {0.0, cos_ds, -depth},
                 {radius * depth, 0.0, 0.0}}};
  return basis;
}

/// Largest difference of two bases relative to the entry of the second.
double relative_distance(const ForceBasis& a, const ForceBasis& b) {
  double largest = 0.0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const auto add = [&](double x, double y) {
        if (x != y) largest = std::max(largest, std::abs(x - y) / std::abs(y));
      };
      add(a.chip[row][column], b.chip[row][column]);
      add(a.edge[row][column], b.edge[row][column]);
    }
  }
  return largest;
}

TEST(BallForce, TendsToItsClosedFormAsTheDepthVanishes) {
  const double phi = 0.9;
  for (const double helix_deg : {-45.0, 0.0, 30.0}) {
    const cutter::Cutter cutter{cutter::Shape::ball, 12.0, 1, core::rad_from_deg(helix_deg)};
    for (const double depth : {1e-6, 1e-4, 1e-2, 1.0}) {
      const ForceBasis found = force_basis(cutter, slot(depth), {}, phi);
      const double off = relative_distance(found, ball_without_helix(6.0, depth, phi));
      std::cout << "helix " << helix_deg << " deg, depth " << depth << " mm: " << off << '\n';
      // What the helix adds is of the order of the lag, over tan(phi) at worst; without it nothing.
      const double lag = std::abs(cutter::lag_rate(cutter)) * depth;
      EXPECT_LE(off, 2.0 * lag + 1e-14);
      if (lag > 0.0) {
        EXPECT_GT(off, 0.01 * lag);
      }
    }
  }
}

TEST(BallForce, ContinuesIntoTheCylinderAboveIt) {
  const cutter::Cutter ball{cutter::Shape::ball, 12.0, 1, core::rad_from_deg(40.0)};
  // The force per depth is continuous at z = R: equal steps below and above add almost the same.
  const double step = 1e-5;
  const auto at = [&](double depth) { return force_basis(ball, slot(depth), {}, 2.0); };
  const ForceBasis low = at(6.0 - step), middle = at(6.0), high = at(6.0 + step);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double below = middle.edge[row][column] - low.edge[row][column];
      const double above = high.edge[row][column] - middle.edge[row][column];
      EXPECT_NEAR(below, above, 3e-3 * 6.0 * step) << row << column;
    }
  }
}

}  // namespace
}  // namespace millstudy::force
