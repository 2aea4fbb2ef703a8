// SPDX-License-Identifier: MIT
// The exact kernel against adaptive quadrature that shares no code with it: long double, in height
// instead of kappa, the formulas of DESIGN.md 2 and 3 written out once more.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <random>
#include <vector>

#include "unit/force/cases.h"

namespace millstudy::force {
namespace {

using Real = long double;
using Vector = std::array<Real, 4>;

constexpr Real kLongPi = 3.14159265358979323846264338327950288L;

/// Force per unit of s at the height z = s^2 of one tooth, the root taking out the tip of a ball.
Vector density(const testing::Case& c, Real tip_angle, Real s) {
  const Real radius = 0.5L * c.cutter.diameter;
  const Real rate = std::tan(static_cast<Real>(c.cutter.helix_angle)) / radius;
  const Real z = s * s;
  const bool flat = c.cutter.shape == cutter::Shape::flat;
  const bool curved = !flat && z < radius;
  const Real r = curved ? std::sqrt(z * (2.0L * radius - z)) : radius;
  const Real slope = curved ? (radius - z) / r : 0.0L;
  const Real sin_kappa = r / radius;
  const Real cos_kappa = curved ? (radius - z) / radius : 0.0L;
  const Real phi = tip_angle - rate * z;
  const Real ds = flat ? 1.0L : std::sqrt(1.0L + slope * slope + r * r * rate * rate);
  const Real db = 1.0L / sin_kappa;
  const Real h = c.feed_per_tooth * std::sin(phi) * sin_kappa;
  const Coefficients& k = c.coefficients;
  const Real ft = k.Kte * ds + k.Ktc * h * db;
  const Real fr = k.Kre * ds + k.Krc * h * db;
  const Real fa = k.Kae * ds + k.Kac * h * db;
  const Real x =
      -fr * std::sin(phi) * sin_kappa - ft * std::cos(phi) - fa * std::sin(phi) * cos_kappa;
  const Real y =
      -fr * std::cos(phi) * sin_kappa + ft * std::sin(phi) - fa * std::cos(phi) * cos_kappa;
  const Real w = 2.0L * s;
  return {w * x, w * y, w * (fr * cos_kappa - fa * sin_kappa), w * r * ft};
}

/// Gauss-Kronrod 7-15 (QUADPACK), halved until the two agree.
Vector integrate(const testing::Case& c, Real tip_angle, Real from, Real to, Real tolerance,
                 int depth = 0) {
  static constexpr std::array<Real, 8> kNodes = {
      0.991455371120812639206854697526329L, 0.949107912342758524526189684047851L,
      0.864864423359769072789712788640926L, 0.741531185599394439863864773280788L,
      0.586087235467691130294144691693460L, 0.405845151377397166906606412076961L,
      0.207784955007898467600689403773245L, 0.0L};
  static constexpr std::array<Real, 8> kKronrod = {
      0.022935322010529224963732008058970L, 0.063092092629978553290700663189204L,
      0.104790010322250183839876322541518L, 0.140653259715525918745189590510238L,
      0.169004726639267902826583426598550L, 0.190350578064785409913256402421014L,
      0.204432940075298892414161999234649L, 0.209482141084727828012999174891714L};
  static constexpr std::array<Real, 4> kGauss = {
      0.129484966168869693270611432679082L, 0.279705391489276667901467771423780L,
      0.381830050505118944950369775488975L, 0.417959183673469387755102040816327L};
  const Real middle = 0.5L * (from + to);
  const Real half = 0.5L * (to - from);
  Vector fine{}, coarse{};
  for (int i = 0; i < 8; ++i) {
    for (const Real sign : {-1.0L, 1.0L}) {
      if (i == 7 && sign > 0.0L) continue;
      const Vector f = density(c, tip_angle, middle + sign * half * kNodes[i]);
      for (int row = 0; row < 4; ++row) {
        fine[row] += half * kKronrod[i] * f[row];
        if (i % 2 == 1) coarse[row] += half * kGauss[i / 2] * f[row];
      }
    }
  }
  Real error = 0.0L;
  for (int row = 0; row < 4; ++row) error = std::max(error, std::abs(fine[row] - coarse[row]));
  if (error < tolerance || depth > 30) return fine;
  const Vector low = integrate(c, tip_angle, from, middle, 0.5L * tolerance, depth + 1);
  Vector sum = integrate(c, tip_angle, middle, to, 0.5L * tolerance, depth + 1);
  for (int row = 0; row < 4; ++row) sum[row] += low[row];
  return sum;
}

/// One tooth: split where the edge crosses an engagement limit and where the ball ends.
void add_tooth(const testing::Case& c, Real tip_angle, Real tolerance, Vector& sum) {
  const Real depth = c.engagement.axial_depth;
  const Real rate = std::tan(static_cast<Real>(c.cutter.helix_angle)) / (0.5L * c.cutter.diameter);
  const Real entry = c.engagement.entry_angle;
  const Real exit = c.engagement.exit_angle;
  std::vector<Real> splits = {0.0L, depth, std::min<Real>(depth, 0.5L * c.cutter.diameter)};
  for (const Real limit : {entry, exit}) {
    const Real a = (tip_angle - limit) / (2.0L * kLongPi);
    const Real b = (tip_angle - rate * depth - limit) / (2.0L * kLongPi);
    for (Real turn = std::ceil(std::min(a, b)); turn <= std::max(a, b); turn += 1.0L) {
      if (rate != 0.0L) splits.push_back((tip_angle - limit - 2.0L * kLongPi * turn) / rate);
    }
  }
  for (Real& split : splits) split = std::clamp(split, 0.0L, depth);
  std::sort(splits.begin(), splits.end());
  for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
    if (splits[i] == splits[i + 1]) continue;
    Real phi = tip_angle - rate * 0.5L * (splits[i] + splits[i + 1]) - entry;
    phi -= 2.0L * kLongPi * std::floor(phi / (2.0L * kLongPi));
    if (phi >= exit - entry) continue;
    const Vector part =
        integrate(c, tip_angle, std::sqrt(splits[i]), std::sqrt(splits[i + 1]), tolerance);
    for (int row = 0; row < 4; ++row) sum[row] += part[row];
  }
}

/// Largest distance from quadrature relative to the peak, over angles of one case.
double distance_from_quadrature(const testing::Case& c, std::mt19937_64& random) {
  const double peak = testing::peak_force(c);
  const double radius = cutter::radius(c.cutter);
  double worst = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double phi = testing::uniform(random, 0.0, 2.0 * core::kPi);
    Vector sum{};
    for (int tooth = 0; tooth < c.cutter.flutes; ++tooth) {
      add_tooth(c, phi + 2.0L * kLongPi * tooth / c.cutter.flutes, 1e-14L * peak, sum);
    }
    testing::Force reference;
    for (int row = 0; row < 4; ++row) reference[row] = static_cast<double>(sum[row]);
    worst = std::max(worst, testing::distance(testing::exact_force(c, phi), reference, radius));
  }
  return peak > 0.0 ? worst / peak : worst;
}

void compare(cutter::Shape shape, const char* name) {
  std::mt19937_64 random(19981);
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const testing::Case c = testing::random_case(random, shape);
    const double found = distance_from_quadrature(c, random);
    EXPECT_LT(found, 1e-10) << c;
    worst = std::max(worst, found);
  }
  std::cout << name << " against adaptive quadrature, 1000 cases of 4 angles: " << worst
            << " of the peak\n";
}

TEST(EdgeForce, AgreesWithAdaptiveQuadratureForFlat) {
  compare(cutter::Shape::flat, "flat");
}

TEST(EdgeForce, AgreesWithAdaptiveQuadratureForBall) {
  compare(cutter::Shape::ball, "ball");
}

}  // namespace
}  // namespace millstudy::force
