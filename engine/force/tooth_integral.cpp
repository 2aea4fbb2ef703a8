// SPDX-License-Identifier: MIT
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// (F9): the cylinder, from the corrected (26) of the paper in midpoint-and-sinc form.
void add_cylinder(Basis<double>& basis, const CuttingEdges& edges, int flute,
                  const EdgePiece& piece, double tip_angle, double z1, double z2) {
  const double tangent = edges.flutes()[flute].helix_tangent;
  const cutter::Envelope& envelope = edges.envelope();
  const double height = z2 - z1;
  const double turn = tangent * (envelope.lag(z2) - envelope.lag(z1));
  const double middle = tip_angle - tangent * (0.5 * (envelope.lag(z1) + envelope.lag(z2)));
  const double ratio = edges.pitch_ratio(flute, 0.0);
  // Integrals over z of sin(phi), cos(phi), sin^2(phi), sin(phi) cos(phi): (F8).
  const double once = height * sinc(0.5 * turn);
  const double twice = height * sinc(turn);
  const double s = once * std::sin(middle);
  const double c = once * std::cos(middle);
  const double ss = 0.5 * (height - twice * std::cos(2.0 * middle));
  const double sc = 0.5 * twice * std::sin(2.0 * middle);
  const double r = piece.segment.foot_radius;
  const double length = envelope.edge_per_width(tangent, r, 1.0, envelope.lag_slope(z1));
  const Matrix43<double> chip = {{{-sc, -ss, 0.0}, {ss, -sc, 0.0}, {0.0, 0.0, -s}, {r * s, 0, 0}}};
  const Matrix43<double> edge = {
      {{-c, -s, 0.0}, {s, -c, 0.0}, {0.0, 0.0, -height}, {r * height, 0.0, 0.0}}};
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      basis.chip[row][column] += ratio * chip[row][column];
      basis.edge[row][column] += length * edge[row][column];
    }
  }
}

}  // namespace

double angle_past_first_limit(double helix_tangent, const Arc& arc, double tip_angle) {
  const double ahead =
      hand(helix_tangent) > 0.0 ? tip_angle - arc.entry_angle : arc.exit_angle - tip_angle;
  const double rest = std::fmod(ahead, core::kTurn);
  const double past = rest < 0.0 ? rest + core::kTurn : rest;
  if (past < kAngleSnap || past > core::kTurn - kAngleSnap) return 0.0;
  const double width = arc.exit_angle - arc.entry_angle;
  return std::abs(past - width) < kAngleSnap ? width : past;
}

void add_node(Basis<double>& basis, const CuttingEdges& edges, Rows rows, int flute,
              const EdgeNode& node, double sin_phi, double cos_phi) {
  const double ratio = edges.pitch_ratio(flute, node.lag);
  const Slice<double> slice = {ratio * sin_phi * node.sin_kappa * node.width, node.length,
                               -ratio * node.cos_kappa * node.width};
  Matrix43<double> axes = edge_axes(sin_phi, cos_phi, node.sin_kappa, node.cos_kappa, node.radius);
  if (rows == Rows::moments) axes = moment_axes(axes, sin_phi, cos_phi, node.radius, node.z);
  add_slice(basis, axes, slice, edges.factors(flute, node));
}

void add_piece(Basis<double>& basis, const CuttingEdges& edges, Rows rows, int flute,
               const EdgePiece& piece, double tip_angle, double z1, double z2) {
  const double tangent = edges.flutes()[flute].helix_tangent;
  edges.for_each_node(piece, tangent, z1, z2, [&](const EdgeNode& node) {
    const double phi = tip_angle - tangent * node.lag;  // (F5)
    add_node(basis, edges, rows, flute, node, std::sin(phi), std::cos(phi));
  });
}

void add_edge(Basis<double>& basis, const CuttingEdges& edges, int flute, double tip_angle,
              double z1, double z2) {
  const bool varies = edges.variable_helix() || edges.variation().with_height();
  for (const EdgePiece& piece : edges.pieces()) {
    const double from = std::max(z1, piece.bottom);
    const double to = std::min(z2, piece.top);
    if (from >= to) continue;
    if (piece.segment.is_cylinder() && !varies) {
      add_cylinder(basis, edges, flute, piece, tip_angle, from, to);
    } else {
      add_piece(basis, edges, Rows::forces, flute, piece, tip_angle, from, to);
    }
  }
}

}  // namespace millstudy::force
