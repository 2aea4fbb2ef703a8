// SPDX-License-Identifier: MIT
#include "cutter/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::cutter {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The general end mill of Engin and Altintas 2001: tip cone, corner arc, taper.
struct Apt {
  double diameter;     ///< where tip cone and taper would meet, twice the radius there
  double corner;       ///< R
  double centre_r;     ///< R_r
  double centre_z;     ///< R_z
  double tip_angle;    ///< alpha
  double taper_angle;  ///< beta
};

/// (C7): the corner arc that touches both lines.
Apt with_tangent_corner(double diameter, double corner, double alpha, double beta) {
  const double ta = std::tan(alpha), tb = std::tan(beta);
  const double u = 0.5 * diameter * (1.0 - ta * tb);  // radius of the taper's line at z = 0
  const double r = (u + corner * (tb / std::cos(alpha) - 1.0 / std::cos(beta))) / (1.0 - ta * tb);
  return {diameter, corner, r, r * ta + corner / std::cos(alpha), alpha, beta};
}

/// What each shape fixes of the general end mill.
Apt apt_of(const Cutter& c) {
  const double r = radius(c);
  switch (c.shape) {
    case Shape::flat:
      return {c.diameter, 0.0, r, 0.0, 0.0, 0.0};
    case Shape::ball: {
      const double beta = c.taper_angle;
      const double meeting = c.diameter * (1.0 - std::sin(beta)) / std::cos(beta);
      return {meeting, r, 0.0, r, 0.0, beta};
    }
    case Shape::bull_nose:
      return {c.diameter, c.corner_radius, r - c.corner_radius, c.corner_radius, 0.0, 0.0};
    case Shape::taper:
      return with_tangent_corner(c.diameter, c.corner_radius, 0.0, c.taper_angle);
    case Shape::general:
      if (!c.corner_centre_radius) {
        return with_tangent_corner(c.diameter, c.corner_radius, c.tip_angle, c.taper_angle);
      }
      return {c.diameter,  c.corner_radius, *c.corner_centre_radius, *c.corner_centre_height,
              c.tip_angle, c.taper_angle};
    case Shape::profile:
      break;
  }
  __builtin_unreachable();
}

/// Where the corner arc leaves the line through (0, 0) of slope tan(alpha), or meets that of the
/// taper; both are tangent points unless the centre was given.
struct Junctions {
  double tip_r, tip_z;
  double taper_r, taper_z;
};

/// Parameter along a line from `at` in unit direction `along` of its crossing with a circle: the
/// larger one (sign +1) or the smaller. NaN if there is none.
double crossing(double at_r, double at_z, double along_r, double along_z, const Apt& a,
                double sign) {
  const double dr = a.centre_r - at_r, dz = a.centre_z - at_z;
  const double near = dr * along_r + dz * along_z;
  const double off = dr * along_z - dz * along_r;
  const double inside = a.corner * a.corner - off * off;
  // A tangent misses by rounding.
  return near +
         sign * std::sqrt(inside < 0.0 && inside > -1e-12 * a.corner * a.corner ? 0.0 : inside);
}

Junctions junctions(const Apt& a, bool tangent) {
  const double ca = std::cos(a.tip_angle), sa = std::sin(a.tip_angle);
  const double cb = std::cos(a.taper_angle), sb = std::sin(a.taper_angle);
  if (tangent) {
    const double tip_r = a.centre_r + a.corner * sa;
    const double taper_z = a.centre_z - a.corner * sb;
    // At alpha = 0 the arc begins on the plane itself: no cone is left over by rounding.
    return {tip_r, a.centre_z - a.corner * ca, a.centre_r + a.corner * cb, taper_z};
  }
  const double u = 0.5 * a.diameter * (1.0 - std::tan(a.tip_angle) * std::tan(a.taper_angle));
  const double s = crossing(0.0, 0.0, ca, sa, a, 1.0);
  const double t = crossing(u, 0.0, sb, cb, a, 1.0);
  return {s * ca, s * sa, u + t * sb, t * cb};
}

[[noreturn]] void refuse(std::string text) {
  throw core::InputError(std::move(text));
}

void add_line(std::vector<Segment>& segments, double z1, double r1, double z2, double slope) {
  if (z2 > z1)
    segments.push_back(
        {.bottom = z1, .top = z2, .is_arc = false, .foot_radius = r1, .slope = slope});
}

std::vector<Segment> apt_segments(const Apt& a, bool tangent) {
  std::vector<Segment> segments;
  const double slope = std::tan(a.taper_angle);
  if (a.corner == 0.0 && tangent) {
    const double tip_z = 0.5 * a.diameter * std::tan(a.tip_angle);
    if (tip_z > 0.0) add_line(segments, 0.0, 0.0, tip_z, 1.0 / std::tan(a.tip_angle));
    add_line(segments, tip_z, 0.5 * a.diameter, kInfinity, slope);
    return segments;
  }
  const Junctions at = junctions(a, tangent);
  constexpr double kRounding = 1e-12;
  const double scale = kRounding * (a.diameter + a.corner);
  if (!(at.tip_r >= -scale && at.tip_z >= -scale && at.taper_z > at.tip_z && at.taper_r > 0.0)) {
    refuse(
        "the corner does not join the tip and the taper: check corner radius, its centre, and "
        "the angles of tip and taper against the diameter");
  }
  const double tip_z = at.tip_z <= scale ? 0.0 : at.tip_z;
  if (tip_z > 0.0) {
    // A bore in the middle (the arc's lowest point above the plane) has no tip cone to stand on.
    if (a.tip_angle <= 0.0)
      refuse(
          "the corner must touch the plane of the tip: give its centre a "
          "height of at most the corner radius, or a tip angle");
    add_line(segments, 0.0, 0.0, tip_z, 1.0 / std::tan(a.tip_angle));
  }
  segments.push_back({.bottom = tip_z,
                      .top = at.taper_z,
                      .is_arc = true,
                      .centre_radius = std::abs(a.centre_r) <= scale ? 0.0 : a.centre_r,
                      .centre_height = a.centre_z,
                      .corner_radius = a.corner});
  add_line(segments, at.taper_z, at.taper_r, kInfinity, slope);
  return segments;
}

std::vector<Segment> profile_segments(const Profile& profile) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto [z1, r1] = profile[i];
    const auto [z2, r2] = profile[i + 1];
    add_line(segments, z1, r1, z2, (r2 - r1) / (z2 - z1));
  }
  return segments;
}

bool all_cylinder(const std::vector<Segment>& segments) {
  return std::all_of(segments.begin(), segments.end(),
                     [](const Segment& segment) { return segment.is_cylinder(); });
}

}  // namespace

double Segment::radius_at(double z) const {
  if (!is_arc) return foot_radius + slope * (z - bottom);
  const double above = std::max(0.0, z - (centre_height - corner_radius));
  return centre_radius + std::sqrt(above * std::max(0.0, 2.0 * corner_radius - above));
}

double Segment::kappa_at(double z) const {
  if (!is_arc) return 0.5 * core::kPi - std::atan(slope);
  // (C8) through the half angle: it keeps its digits at both ends, which asin((r - R_r)/R) does not
  // where r is largest.
  const double above = z - (centre_height - corner_radius);
  return 2.0 * std::asin(std::sqrt(std::clamp(above / (2.0 * corner_radius), 0.0, 1.0)));
}

Envelope::Envelope(const Cutter& cutter) : diameter_(cutter.diameter), helix_from_(kInfinity) {
  if (cutter.shape == Shape::profile) {
    segments_ = profile_segments(*cutter.profile);
  } else {
    segments_ = apt_segments(apt_of(cutter), !(cutter.shape == Shape::general &&
                                               cutter.corner_centre_radius.has_value()));
    if (segments_.back().slope < 0.0) {
      segments_.back().top =
          segments_.back().bottom - segments_.back().foot_radius / segments_.back().slope;
    }
    if (cutter.lead == Lead::constant_helix) {
      helix_from_ = segments_.back().bottom;
      helix_radius_ = segments_.back().foot_radius;
      helix_slope_ = segments_.back().slope;
      helix_sine_ = std::sin(std::atan(helix_slope_));
    }
  }
  if (cutter.flute_length)
    segments_.back().top = std::min(segments_.back().top, *cutter.flute_length);
  while (segments_.size() > 1 && segments_.back().top <= segments_.back().bottom) {
    segments_.pop_back();
    segments_.back().top = std::min(segments_.back().top, *cutter.flute_length);
  }
  edge_is_chip_width_ = cutter.edge_measure == EdgeMeasure::chip_width ||
                        (cutter.edge_measure == EdgeMeasure::automatic && all_cylinder(segments_));
}

const Segment& Envelope::segment_at(double z) const {
  std::size_t i = 0;
  while (i + 1 < segments_.size() && z >= segments_[i].top) ++i;
  return segments_[i];
}

double Envelope::lag(double z) const {
  const double low = std::min(z, helix_from_);
  const double below = 2.0 * low / diameter_;
  if (z <= helix_from_) return below;
  const double grown = helix_slope_ * (z - helix_from_) / helix_radius_;
  const double per_height = 1.0 / (helix_radius_ * std::sqrt(1.0 - helix_sine_ * helix_sine_));
  return below + (z - helix_from_) * per_height * (grown == 0.0 ? 1.0 : std::log1p(grown) / grown);
}

double Envelope::lag_slope(double z) const {
  if (z < helix_from_) return 2.0 / diameter_;
  const double r = helix_radius_ + helix_slope_ * (z - helix_from_);
  return 1.0 / (r * std::sqrt(1.0 - helix_sine_ * helix_sine_));
}

double Envelope::height_at_lag(double lag_sought) const {
  const double below = 2.0 * helix_from_ / diameter_;
  if (lag_sought <= below) return 0.5 * diameter_ * lag_sought;
  const double x = (lag_sought - below) * helix_sine_;
  return helix_from_ + (lag_sought - below) * helix_radius_ *
                           std::sqrt(1.0 - helix_sine_ * helix_sine_) *
                           (x == 0.0 ? 1.0 : std::expm1(x) / x);
}

double Envelope::edge_per_width(double helix_tangent, double radius, double sin_kappa,
                                double lag_slope) const {
  if (edge_is_chip_width_) return 1.0;
  const double bend = helix_tangent * radius * lag_slope * sin_kappa;
  return std::sqrt(1.0 + bend * bend);
}

EnvelopePoint envelope(const Cutter& cutter, double z) {
  const Envelope shape(cutter);
  const Segment& segment = shape.segment_at(z);
  const double helix =
      cutter.helix_angles.empty() ? cutter.helix_angle : cutter.helix_angles.front();
  return {segment.radius_at(z), segment.kappa_at(z), std::tan(helix) * shape.lag(z)};
}

namespace {

/// x - sin(x), also where they are nearly equal: its Taylor series below 1, to rounding.
double less_its_sine(double x) {
  if (x > 1.0) return x - std::sin(x);
  double sum = 1.0;
  for (int n = 18; n >= 4; n -= 2) sum = 1.0 - x * x / (n * (n + 1)) * sum;
  return x * x * x / 6.0 * sum;
}

double section_below(const Segment& segment, double z) {
  if (!segment.is_arc) {
    const double height = z - segment.bottom;
    return height * (segment.foot_radius + 0.5 * segment.slope * height);
  }
  const double square = segment.corner_radius * segment.corner_radius;
  return segment.centre_radius * (z - segment.bottom) +
         0.25 * square *
             (less_its_sine(2.0 * segment.kappa_at(z)) -
              less_its_sine(2.0 * segment.kappa_at(segment.bottom)));
}

}  // namespace

double section_area(const Envelope& envelope, double depth) {
  double area = 0.0;
  for (const Segment& segment : envelope.segments()) {
    if (depth > segment.bottom) area += section_below(segment, std::min(depth, segment.top));
  }
  return area;
}

double largest_sin_kappa(const Envelope& envelope, double depth) {
  double largest = 0.0;
  for (const Segment& segment : envelope.segments()) {
    if (segment.bottom > 0.0 && depth <= segment.bottom) break;
    const double low = segment.kappa_at(segment.bottom);
    const double high = segment.kappa_at(std::min(depth, segment.top));
    if (low <= 0.5 * core::kPi && high >= 0.5 * core::kPi) return 1.0;
    largest = std::max({largest, std::sin(low), std::sin(high)});
  }
  return largest;
}

}  // namespace millstudy::cutter
