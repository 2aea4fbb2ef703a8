// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <random>

#include "core/units.h"
#include "force/force_basis.h"

/// Seeded random cuts, and how far two forces are apart, for the tests of force/.
namespace millstudy::force::testing {

/// GGG-70 of haber2004.
inline constexpr Coefficients kGgg70 = {2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};

/// The tool of haber2004, with two flutes.
inline cutter::Cutter haber_cutter(cutter::Shape shape) {
  return {shape, 12.0, 2, core::rad_from_deg(30.0)};
}

struct Case {
  cutter::Cutter cutter;
  Engagement engagement;
  double feed_per_tooth;
  Coefficients coefficients;
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << (c.cutter.shape == cutter::Shape::flat ? "flat" : "ball")
             << " D=" << c.cutter.diameter << " N=" << c.cutter.flutes
             << " helix_deg=" << core::deg_from_rad(c.cutter.helix_angle)
             << " entry=" << c.engagement.entry_angle << " exit=" << c.engagement.exit_angle
             << " depth=" << c.engagement.axial_depth << " feed=" << c.feed_per_tooth;
}

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

/// Helix from 0 through 1e-8 deg to 60 deg, both hands; slots, up, down and interior engagements,
/// some very narrow; depths from microns to several turns of the helix.
inline Case random_case(std::mt19937_64& random, cutter::Shape shape) {
  Case c;
  c.cutter = {shape, uniform(random, 2.0, 25.0), 1 + static_cast<int>(random() % 6), 0.0};
  switch (random() % 4) {
    case 0:
      break;
    case 1:
      c.cutter.helix_angle = std::pow(10.0, uniform(random, -8.0, 0.0));
      break;
    default:
      c.cutter.helix_angle = uniform(random, 1.0, 60.0);
  }
  c.cutter.helix_angle = core::rad_from_deg(c.cutter.helix_angle);
  if (random() % 2) c.cutter.helix_angle = -c.cutter.helix_angle;
  const double radius = cutter::radius(c.cutter);
  const double depth = radius * std::pow(10.0, uniform(random, -3.0, 1.3));
  const double radial = 2.0 * radius * std::pow(10.0, uniform(random, -3.0, 0.0));
  switch (random() % 4) {
    case 0:
      c.engagement = slot(depth);
      break;
    case 1:
      c.engagement = up_milling(radius, radial, depth);
      break;
    case 2:
      c.engagement = down_milling(radius, radial, depth);
      break;
    default: {
      const double a = uniform(random, 0.0, core::kPi);
      const double b = uniform(random, 0.0, core::kPi);
      c.engagement = {std::min(a, b), std::max(a, b) + 1e-3 * (core::kPi - std::max(a, b)), depth};
    }
  }
  c.feed_per_tooth = uniform(random, 0.01, 0.3);
  c.coefficients = kGgg70;
  return c;
}

using Force = std::array<double, kRows>;

inline Force exact_force(const Case& c, double phi) {
  return evaluate(force_basis(c.cutter, c.engagement, {}, phi), c.coefficients, {c.feed_per_tooth});
}

/// Largest row of a - b, each against its own scale: forces [N], torque [N mm] over the radius.
inline double distance(const Force& a, const Force& b, double radius) {
  double largest = 0.0;
  for (int row = 0; row < kRows; ++row) {
    largest = std::max(largest, std::abs(a[row] - b[row]) / (row == 3 ? radius : 1.0));
  }
  return largest;
}

/// Largest force over a revolution [N], from 720 angles.
inline double peak_force(const Case& c) {
  double peak = 0.0;
  for (int i = 0; i < 720; ++i) {
    const double phi = 2.0 * core::kPi * (i + 0.5) / 720;
    peak = std::max(peak, distance(exact_force(c, phi), Force{}, cutter::radius(c.cutter)));
  }
  return peak;
}

}  // namespace millstudy::force::testing
