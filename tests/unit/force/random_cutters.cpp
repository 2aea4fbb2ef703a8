// SPDX-License-Identifier: MIT
#include "unit/force/random_cutters.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace millstudy::force::testing {
namespace {

using cutter::Cutter;
using cutter::Shape;
using reference::Cut;
using Random = std::mt19937_64;

bool one_in(Random& random, int n) {
  return random() % n == 0;
}

double degrees(Random& random, double low, double high) {
  return core::rad_from_deg(uniform(random, low, high));
}

/// Both signs, sometimes none.
double taper_angle(Random& random) {
  return one_in(random, 8)   ? 0.0
         : one_in(random, 3) ? degrees(random, -25.0, -0.5)
                             : degrees(random, 0.5, one_in(random, 5) ? 60.0 : 20.0);
}

std::shared_ptr<const cutter::Profile> random_profile(Random& random, double radius) {
  cutter::Profile profile;
  const int points = 2 + static_cast<int>(random() % 5);
  double z = 0.0;
  for (int i = 0; i < points; ++i) {
    const double r = i == 0 && one_in(random, 3) ? 0.0 : radius * uniform(random, 0.05, 1.2);
    profile.push_back({z, i > 0 && one_in(random, 4) ? profile.back().r : r});
    z += radius * std::pow(10.0, uniform(random, -1.5, 0.8));
  }
  return std::make_shared<const cutter::Profile>(std::move(profile));
}

/// A circle that crosses tip and taper: the tangent one of a smaller radius, grown.
void centre_the_corner(Random& random, Cutter& c) {
  const double small = c.corner_radius * uniform(random, 0.6, 1.0);
  const double ta = std::tan(c.tip_angle), tb = std::tan(c.taper_angle);
  const double meet_r = 0.5 * c.diameter, meet_z = meet_r * ta;
  const double along =
      (small / std::cos(c.taper_angle) - small * tb / std::cos(c.tip_angle)) / (1.0 - ta * tb);
  c.corner_centre_radius = meet_r - along;
  c.corner_centre_height = meet_z - along * ta + small / std::cos(c.tip_angle);
}

void set_shape(Random& random, Kind kind, Cutter& c) {
  const double radius = 0.5 * c.diameter;
  c.corner_radius = radius * uniform(random, 0.02, 0.9);
  switch (kind) {
    case Kind::flat:
      c.shape = Shape::flat;
      break;
    case Kind::ball:
      c.shape = Shape::ball;
      break;
    case Kind::tapered_ball:
      c.shape = Shape::ball;
      c.taper_angle = taper_angle(random);
      break;
    case Kind::bull_nose:
      c.shape = Shape::bull_nose;
      break;
    case Kind::taper:
      c.shape = Shape::taper;
      c.taper_angle = taper_angle(random);
      if (one_in(random, 3)) c.corner_radius = 0.0;
      break;
    case Kind::general:
    case Kind::general_centred:
      c.shape = Shape::general;
      c.taper_angle = taper_angle(random);
      c.tip_angle = one_in(random, 4) ? 0.0 : degrees(random, 0.5, one_in(random, 4) ? 60.0 : 15.0);
      if (kind == Kind::general_centred) {
        centre_the_corner(random, c);
      } else if (one_in(random, 5)) {
        c.corner_radius = 0.0;
      }
      break;
    case Kind::profile:
      c.shape = Shape::profile;
      c.profile = random_profile(random, radius);
  }
  if (kind != Kind::profile && one_in(random, 3)) c.lead = cutter::Lead::constant_helix;
  if (one_in(random, 4)) c.edge_measure = cutter::EdgeMeasure::edge_length;
  if (one_in(random, 8)) c.edge_measure = cutter::EdgeMeasure::chip_width;
}

void set_flutes(Random& random, Cutter& c) {
  c.flutes = 1 + static_cast<int>(random() % 6);
  const double hand = one_in(random, 3) ? -1.0 : 1.0;
  const double helix_deg = one_in(random, 6)   ? 0.0
                           : one_in(random, 6) ? std::pow(10.0, uniform(random, -8.0, 0.0))
                                               : uniform(random, 1.0, 60.0);
  c.helix_angle = hand * core::rad_from_deg(helix_deg);
  if (one_in(random, 3)) {
    for (int j = 0; j < c.flutes; ++j) {
      c.helix_angles.push_back(
          hand * core::rad_from_deg(std::clamp(helix_deg + uniform(random, -8.0, 8.0), 0.0, 65.0)));
    }
    if (hand < 0.0) {
      for (double& angle : c.helix_angles) angle = std::min(angle, -1e-9);
    }
  }
  if (one_in(random, 2)) return;
  double sum = 0.0;
  for (int j = 0; j < c.flutes; ++j) {
    c.pitch_angles.push_back(one_in(random, 4) ? uniform(random, 0.1, 2.0)
                                               : uniform(random, 0.8, 1.2));
    sum += c.pitch_angles.back();
  }
  for (double& pitch : c.pitch_angles) pitch *= 2.0 * core::kPi / sum;
}

void set_runout(Random& random, double feed, double depth, Cutter& c) {
  const auto size = [&] { return feed * std::pow(10.0, uniform(random, -2.0, 0.5)); };
  const int which = static_cast<int>(random() % 5);
  if (which < 2) return;
  if (which != 3) c.runout.offset = size();
  if (which > 2) c.runout.tilt = std::min(std::atan(size() / depth), core::rad_from_deg(9.9));
  c.runout.angle = uniform(random, -4.0, 7.0);
  c.runout.tilt_angle = uniform(random, -4.0, 7.0);
}

std::vector<Arc> random_arcs(Random& random, double radius) {
  const double radial = 2.0 * radius * std::pow(10.0, uniform(random, -3.0, 0.0));
  const auto sorted = [&](int count) {
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) angles.push_back(uniform(random, 0.0, core::kPi));
    std::sort(angles.begin(), angles.end());
    return angles;
  };
  switch (random() % 5) {
    case 0:
      return {slot(1.0).arc()};
    case 1:
      return {up_milling(radius, radial, 1.0).arc()};
    case 2:
      return {down_milling(radius, radial, 1.0).arc()};
    case 3: {
      const auto a = sorted(2);
      return {{a[0], a[1]}};
    }
    default: {
      const auto a = sorted(4);
      return {{a[0], a[1]}, {a[2], a[3]}};
    }
  }
}

std::shared_ptr<const HeightFactors> random_heights(Random& random, double depth) {
  HeightFactors f;
  const bool tables = one_in(random, 2);
  if (tables) {
    double z = one_in(random, 2) ? 0.0 : depth * uniform(random, 0.0, 0.4);
    for (int i = 0; i < 1 + static_cast<int>(random() % 4); ++i) {
      f.heights.push_back(z);
      z += depth * uniform(random, 0.05, 0.5);
    }
  }
  for (int q = 0; q < 6; ++q) {
    if (tables && !one_in(random, 4)) {
      for (std::size_t i = 0; i < f.heights.size(); ++i) {
        f.table[q].push_back(uniform(random, 0.3, 2.0));
      }
    }
    if (tables && one_in(random, 2)) continue;
    for (int n = 1; n <= static_cast<int>(random() % 5); ++n) {
      f.polynomial[q].push_back(uniform(random, -0.25, 0.5) / std::pow(depth, n));
    }
  }
  return std::make_shared<const HeightFactors>(std::move(f));
}

void set_variation(Random& random, double depth, Cut& cut) {
  Variation& v = cut.variation;
  const int which = static_cast<int>(random() % 8);  // 3 of 8 are constant
  if (which == 0 || which == 4) v.height = random_heights(random, depth);
  if (which == 1 || which == 4) {
    for (double& m : v.size_exponent) {
      if (!one_in(random, 4)) m = uniform(random, 0.02, one_in(random, 6) ? 0.95 : 0.5);
    }
    v.reference_chip_thickness = one_in(random, 2) ? 1.0 : uniform(random, 0.02, 1.0);
  }
  if (which == 2 || which == 3) {
    const double rate = which == 3 ? 1.0 : 0.0;
    v.orthogonal = OrthogonalData{
        {uniform(random, 400.0, 900.0), uniform(random, -100.0, 100.0),
         rate * uniform(random, -100.0, 100.0)},
        {uniform(random, 0.4, 0.6), uniform(random, 0.0, 0.3), rate * uniform(random, -0.05, 0.05)},
        {uniform(random, 0.4, 0.6), uniform(random, 0.0, 0.3), rate * uniform(random, -0.05, 0.05)},
        degrees(random, -8.0, 15.0)};
    cut.coefficients.Ktc = uniform(random, 0.8, 1.2);
    cut.coefficients.Krc = uniform(random, 0.8, 1.2);
    cut.coefficients.Kac = uniform(random, 0.8, 1.2);
  }
}

Cut drawn_cut(Random& random, Kind kind) {
  Cut cut;
  Cutter& c = cut.cutter;
  c.diameter = uniform(random, 2.0, 25.0);
  const double radius = 0.5 * c.diameter;
  set_shape(random, kind, c);
  set_flutes(random, c);
  double depth = radius * std::pow(10.0, uniform(random, -3.3, 1.3));
  if (one_in(random, 6)) c.flute_length = depth * uniform(random, 1.0, 2.0);
  const double length = reference::Tool(c).length();
  if (depth >= length) depth = length * uniform(random, 0.1, 0.98);
  cut.axial_depth = depth;
  cut.arcs = random_arcs(random, radius);
  cut.feed.per_tooth = uniform(random, 0.01, 0.3);
  if (one_in(random, 3)) cut.feed.slope = degrees(random, -15.0, 15.0);
  set_runout(random, cut.feed.per_tooth, depth, c);
  cut.coefficients = kGgg70;
  set_variation(random, depth, cut);
  return cut;
}

}  // namespace

Cut random_cut(Random& random, Kind kind) {
  for (;;) {
    const Cut cut = drawn_cut(random, kind);
    try {
      cutter::check(cut.cutter);
      for (const Arc& arc : cut.arcs) {
        check(cut.cutter, {arc.entry_angle, arc.exit_angle, cut.axial_depth});
      }
      return cut;
    } catch (const core::InputError&) {
    }
  }
}

}  // namespace millstudy::force::testing
