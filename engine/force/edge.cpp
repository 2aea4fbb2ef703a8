// SPDX-License-Identifier: MIT
#include "force/edge.h"

#include <algorithm>
#include <limits>

#include "core/units.h"

namespace millstudy::force {

CuttingEdges::CuttingEdges(const cutter::Cutter& cutter, double axial_depth,
                           const Variation& variation)
    : cutter_(cutter),
      envelope_(cutter),
      variation_(variation),
      axial_depth_(axial_depth),
      flutes_(cutter::flutes(cutter)),
      equal_flutes_(cutter::has_equal_flutes(cutter) && !cutter::has_runout(cutter)),
      variable_helix_(cutter::has_variable_helix(cutter)) {
  for (const cutter::Flute& flute : flutes_) {
    steepest_ = std::max(steepest_, std::abs(flute.helix_tangent));
  }
  for (const cutter::Segment& segment : envelope_.segments()) {
    if (segment.bottom >= axial_depth) break;
    double bottom = segment.bottom;
    const double top = std::min(segment.top, axial_depth);
    if (variation.height) {
      for (const double corner : variation.height->heights) {
        if (corner <= bottom || corner >= top) continue;
        add_pieces(segment, bottom, corner);
        bottom = corner;
      }
    }
    add_pieces(segment, bottom, top);
  }
}

void CuttingEdges::add_pieces(const cutter::Segment& segment, double bottom, double top) {
  const EdgePiece whole = {segment, bottom, top};
  // Cylinders have closed forms of any length, as long as nothing on them varies with height.
  const bool closed = segment.is_cylinder() && !variable_helix_ && !variation_.with_height() &&
                      !variation_.with_chip() && !cutter::has_runout(cutter_);
  const int parts =
      closed ? 1 : 1 + static_cast<int>(span(whole, steepest_, bottom, top) / kLongestPanel);
  double from = bottom;
  for (int i = 1; i <= parts; ++i) {
    double to = top;
    if (i < parts) {
      const double p1 = variable(whole, bottom), p2 = variable(whole, top);
      to = node(whole, 0.0, p1 + (p2 - p1) * i / parts, 1.0).z;
    }
    pieces_.push_back({segment, from, to});
    from = to;
  }
}

double CuttingEdges::pitch_ratio(int flute, double lag, int teeth) const {
  const auto count = static_cast<int>(flutes_.size());
  const bool wraps = flute + teeth >= count;
  const cutter::Flute& own = flutes_[flute];
  const cutter::Flute& next = flutes_[wraps ? flute + teeth - count : flute + teeth];
  const double pitch = next.position + (wraps ? core::kTurn : 0.0) - own.position -
                       (next.helix_tangent - own.helix_tangent) * lag;
  return pitch * count / core::kTurn;
}

double CuttingEdges::inclination(int flute, const EdgeNode& node) const {
  return std::atan(flutes_[flute].helix_tangent * node.radius * envelope_.lag_slope(node.z) *
                   node.sin_kappa);
}

std::array<double, 6> CuttingEdges::factors(int flute, const EdgeNode& node) const {
  std::array<double, 6> all = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  if (variation_.height) all = height_factors(*variation_.height, node.z);
  if (variation_.orthogonal) {
    const std::array<double, 3> k =
        oblique_coefficients(*variation_.orthogonal, inclination(flute, node), 0.0);
    for (int q = 0; q < 3; ++q) all[q] *= k[q];
  }
  return all;
}

EdgeNode CuttingEdges::node(const EdgePiece& piece, double helix_tangent, double p,
                            double dp) const {
  const cutter::Segment& segment = piece.segment;
  EdgeNode node;
  if (segment.is_arc) {
    const double half_sine = std::sin(0.5 * p);
    node.sin_kappa = std::sin(p);
    node.cos_kappa = std::cos(p);
    node.z = segment.centre_height - segment.corner_radius +
             2.0 * segment.corner_radius * half_sine * half_sine;
    node.radius = segment.centre_radius + segment.corner_radius * node.sin_kappa;
    node.width = segment.corner_radius * dp;
  } else {
    const double along = std::sqrt(1.0 + segment.slope * segment.slope);
    node.z = p;
    node.sin_kappa = 1.0 / along;
    node.cos_kappa = segment.slope / along;
    node.radius = segment.foot_radius + segment.slope * (p - segment.bottom);
    node.width = along * dp;
  }
  node.lag = envelope_.lag(node.z);
  node.length = node.width * envelope_.edge_per_width(helix_tangent, node.radius, node.sin_kappa,
                                                      envelope_.lag_slope(node.z));
  return node;
}

double CuttingEdges::span(const EdgePiece& piece, double helix_tangent, double z1,
                          double z2) const {
  const double tangent = std::abs(helix_tangent);
  // An edge length per width of (C10) has branch points at sin^2(kappa) = +-i / tan(helix) on a
  // ball: they come closer to the axis as the helix steepens.
  if (piece.segment.is_arc) {
    return (piece.segment.kappa_at(z2) - piece.segment.kappa_at(z1)) * (1.0 + tangent);
  }
  const double lag = tangent * (envelope_.lag(z2) - envelope_.lag(z1));
  if (piece.segment.is_cylinder()) return lag;
  const double r1 = piece.segment.radius_at(z1);
  const double r2 = piece.segment.radius_at(z2);
  if (cutter_.lead == cutter::Lead::constant_helix) {
    return lag + 2.0 * std::abs(std::log(std::max(r2, 1e-3 * r1) / std::max(r1, 1e-3 * r2)));
  }
  const double bend = tangent * envelope_.lag_slope(z1);
  return lag + 2.0 * std::abs(std::asinh(bend * r2) - std::asinh(bend * r1));
}

EdgeNode CuttingEdges::disc(double helix_tangent, int n, int i) const {
  const double height = axial_depth_ / n;
  const double z = (i + 0.5) * height;
  const cutter::Segment& segment = envelope_.segment_at(z);
  EdgeNode node;
  const double kappa = segment.kappa_at(z);
  node.z = z;
  node.radius = segment.radius_at(z);
  node.sin_kappa = segment.is_cylinder() ? 1.0 : std::sin(kappa);
  node.cos_kappa = segment.is_cylinder() ? 0.0 : std::cos(kappa);
  node.lag = envelope_.lag(z);
  node.width = height / node.sin_kappa;
  node.length = node.width * envelope_.edge_per_width(helix_tangent, node.radius, node.sin_kappa,
                                                      envelope_.lag_slope(z));
  return node;
}

EdgePoint edge_point(const cutter::Envelope& envelope, double helix_tangent, double z) {
  const double lag = envelope.lag(z), psi = helix_tangent * lag;
  return {z, lag, {std::cos(psi), std::sin(psi)}};
}

}  // namespace millstudy::force
