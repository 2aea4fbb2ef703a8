// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "unit/force/reference_integral.h"

namespace millstudy::force::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Stretch line(double bottom, double top, double r, double slope) {
  return {bottom, top, false, r, slope, 0.0, 0.0, 0.0};
}

struct Meridian {
  std::vector<Stretch> stretches;
  double taper_angle = 0.0;
};

/// Tip cone, an arc about a centre, taper: the tip ends and the taper begins at given points.
Meridian assemble(double alpha, double beta, double centre_r, double centre_z, double radius,
                  double tip_z, double taper_z, double taper_r) {
  Meridian m{{}, beta};
  if (tip_z > 1e-12 * (centre_z + radius)) {
    m.stretches.push_back(line(0.0, tip_z, 0.0, 1.0 / std::tan(alpha)));
  } else {
    tip_z = 0.0;
  }
  if (radius > 0.0) {
    m.stretches.push_back({tip_z, taper_z, true, 0.0, 0.0, centre_r, centre_z, radius});
  }
  const double top = beta < 0.0 ? taper_z - taper_r / std::tan(beta) : kInfinity;
  m.stretches.push_back(line(taper_z, top, taper_r, std::tan(beta)));
  return m;
}

/// The lines meet at (D/2, D/2 tan alpha); the arc's centre is one radius from both. Inward
/// normals:
/// (-sin alpha, cos alpha) of the tip, (-cos beta, sin beta) of the taper.
Meridian tangent_corner(double half, double radius, double alpha, double beta) {
  const double n1r = -std::sin(alpha), n1z = std::cos(alpha);
  const double n2r = -std::cos(beta), n2z = std::sin(beta);
  const double det = n1r * n2z - n1z * n2r;
  const double r = half + radius * (n2z - n1z) / det;
  // A flat bottom's arc begins on the plane itself: a rounding there is a kappa of its root.
  const double z = alpha == 0.0 ? radius : half * std::tan(alpha) + radius * (n1r - n2r) / det;
  return assemble(alpha, beta, r, z, radius, z - radius * n1z, z - radius * n2z, r - radius * n2r);
}

/// A centre that was given: the arc goes from the outer crossing with the tip's line to the upper
/// crossing with the taper's.
Meridian given_corner(double half, double radius, double r, double z, double alpha, double beta) {
  const double across = z * std::cos(alpha) - r * std::sin(alpha);
  const double along = r * std::cos(alpha) + z * std::sin(alpha) +
                       std::sqrt(std::max(0.0, radius * radius - across * across));
  const double meet_z = half * std::tan(alpha);
  const double dr = r - half, dz = z - meet_z;
  const double off = dr * std::cos(beta) - dz * std::sin(beta);
  const double up = dr * std::sin(beta) + dz * std::cos(beta) +
                    std::sqrt(std::max(0.0, radius * radius - off * off));
  return assemble(alpha, beta, r, z, radius, along * std::sin(alpha), meet_z + up * std::cos(beta),
                  half + up * std::sin(beta));
}

Meridian meridian_of(const cutter::Cutter& c) {
  const double half = 0.5 * c.diameter;
  switch (c.shape) {
    case cutter::Shape::flat:
      return tangent_corner(half, 0.0, 0.0, 0.0);
    case cutter::Shape::ball: {
      const double b = c.taper_angle;
      return assemble(0.0, b, 0.0, half, half, 0.0, half - half * std::sin(b), half * std::cos(b));
    }
    case cutter::Shape::bull_nose:
      return tangent_corner(half, c.corner_radius, 0.0, 0.0);
    case cutter::Shape::taper:
      return tangent_corner(half, c.corner_radius, 0.0, c.taper_angle);
    case cutter::Shape::general:
      if (!c.corner_centre_radius) {
        return tangent_corner(half, c.corner_radius, c.tip_angle, c.taper_angle);
      }
      return given_corner(half, c.corner_radius, *c.corner_centre_radius, *c.corner_centre_height,
                          c.tip_angle, c.taper_angle);
    case cutter::Shape::profile:
      break;
  }
  Meridian m;
  for (std::size_t i = 1; i < c.profile->size(); ++i) {
    const cutter::ProfilePoint low = (*c.profile)[i - 1], high = (*c.profile)[i];
    m.stretches.push_back(line(low.z, high.z, low.r, (high.r - low.r) / (high.z - low.z)));
  }
  return m;
}

}  // namespace

Tool::Tool(const cutter::Cutter& c)
    : runout_(c.runout), diameter_(c.diameter), taper_from_(kInfinity), taper_radius_(0.0) {
  Meridian m = meridian_of(c);
  taper_angle_ = m.taper_angle;
  if (c.lead == cutter::Lead::constant_helix && c.shape != cutter::Shape::profile) {
    taper_from_ = m.stretches.back().bottom;
    taper_radius_ = m.stretches.back().r;
  }
  for (const Stretch& s : m.stretches) {
    if (c.flute_length && s.bottom >= *c.flute_length) break;
    stretches_.push_back(s);
    if (c.flute_length) stretches_.back().top = std::min(s.top, *c.flute_length);
  }
  double at = 0.0;
  for (int j = 0; j < c.flutes; ++j) {
    position_.push_back(at);
    at += c.pitch_angles.empty() ? 2.0 * M_PI / c.flutes : c.pitch_angles[j];
    tangent_.push_back(std::tan(c.helix_angles.empty() ? c.helix_angle : c.helix_angles[j]));
  }
  bool cylinder = true;
  for (const Stretch& s : stretches_) cylinder = cylinder && !s.arc && s.slope == 0.0;
  per_width_ = c.edge_measure == cutter::EdgeMeasure::chip_width ||
               (c.edge_measure == cutter::EdgeMeasure::automatic && cylinder);
}

Place Tool::place(double z) const {
  std::size_t i = 0;
  while (i + 1 < stretches_.size() && z > stretches_[i].top) ++i;
  const Stretch& s = stretches_[i];
  if (!s.arc) {
    const double kappa = std::atan2(1.0, s.slope);  // tan(kappa) = 1 / (dr/dz)
    return {s.r + s.slope * (z - s.bottom), std::sin(kappa), std::cos(kappa)};
  }
  const double above = std::max(0.0, z - (s.centre_z - s.arc_radius));
  const double out = std::sqrt(above * std::max(0.0, 2.0 * s.arc_radius - above));
  return {s.centre_r + out, out / s.arc_radius, (s.centre_z - z) / s.arc_radius};
}

double Tool::lambda(double z) const {
  if (z <= taper_from_) return 2.0 * z / diameter_;
  const double below = 2.0 * taper_from_ / diameter_;
  if (taper_angle_ == 0.0) return below + (z - taper_from_) / taper_radius_;
  return below + std::log1p((z - taper_from_) * std::tan(taper_angle_) / taper_radius_) /
                     std::sin(taper_angle_);
}

double Tool::lambda_slope(double z) const {
  if (z <= taper_from_) return 2.0 / diameter_;
  const double r = taper_radius_ + (z - taper_from_) * std::tan(taper_angle_);
  return 1.0 / (r * std::cos(taper_angle_));
}

}  // namespace millstudy::force::reference
