// SPDX-License-Identifier: MIT
#include "force/nonlinear_force.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "force/chip_regimes.h"
#include "force/gathered_nodes.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// Ktc Krc Kac [N/mm2] and Kte Kre Kae [N/mm] at a node under a chip, (F17)-(F19); shape (6).
std::array<double, 6> coefficients_at(const CuttingEdges& edges, const Coefficients& k, int flute,
                                      const EdgeNode& node, double chip_thickness) {
  const Variation& variation = edges.variation();
  std::array<double, 6> all = {k.Ktc, k.Krc, k.Kac, k.Kte, k.Kre, k.Kae};
  if (variation.height) {
    const std::array<double, 6> factors = height_factors(*variation.height, node.z);
    for (int q = 0; q < 6; ++q) all[q] *= factors[q];
  }
  if (variation.orthogonal) {
    const std::array<double, 3> oblique =
        oblique_coefficients(*variation.orthogonal, edges.inclination(flute, node), chip_thickness);
    for (int q = 0; q < kColumns; ++q) all[q] *= oblique[q];
  }
  for (int q = 0; q < kColumns; ++q) {
    const double m = variation.size_exponent[q];
    if (m != 0.0) all[q] *= std::pow(chip_thickness / variation.reference_chip_thickness, -m);
  }
  return all;
}

}  // namespace

/// What one flute adds up at one angle.
struct NonlinearForce::Sum {
  const CuttingEdges& edges;
  const ChipLaw& law;
  const Coefficients& coefficients;
  const Feed& feed;
  int flute;
  double sin_tip;
  double cos_tip;
  Rows rows;
  std::vector<Reach> reaches;
  std::array<double, kRows> force{};

  void add(const EdgeNode& node) {
    const double psi = edges.flutes()[flute].helix_tangent * node.lag;
    const double c = std::cos(psi), s = std::sin(psi);
    const double sin_phi = sin_tip * c - cos_tip * s;  // (F5)
    const double cos_phi = cos_tip * c + sin_tip * s;
    law.find(flute, {node.z, node.lag, {c, s}}, reaches);
    const double h = ChipLaw::thickness(reaches, feed, sin_phi, node.sin_kappa, node.cos_kappa);
    if (h <= 0.0) return;
    const std::array<double, 6> k = coefficients_at(edges, coefficients, flute, node, h);
    Matrix43<double> axes =
        edge_axes(sin_phi, cos_phi, node.sin_kappa, node.cos_kappa, node.radius);
    if (rows == Rows::moments) axes = moment_axes(axes, sin_phi, cos_phi, node.radius, node.z);
    for (int column = 0; column < kColumns; ++column) {
      const double along = k[column] * h * node.width + k[kColumns + column] * node.length;  // (F2)
      for (int row = 0; row < kRows; ++row) force[row] += axes[row][column] * along;
    }
  }
};

std::array<double, kRows> NonlinearForce::of_flute(int flute, double tip_angle,
                                                   std::span<const Arc> arcs,
                                                   const Coefficients& coefficients,
                                                   const Feed& feed, Rows rows) const {
  const CuttingEdges& edges = *edges_;
  const double tangent = edges.flutes()[flute].helix_tangent;
  Sum sum{edges,
          law_,
          coefficients,
          feed,
          flute,
          std::sin(tip_angle),
          std::cos(tip_angle),
          rows,
          std::vector<Reach>(law_.reaches())};
  if (edge_rule_.rule == Rule::discs) {
    for (const Arc& arc : arcs) {
      for (int i = 0; i < edge_rule_.discs; ++i) {
        const EdgeNode disc = edges.disc(tangent, edge_rule_.discs, i);
        const double past = angle_past_first_limit(tangent, arc, tip_angle - tangent * disc.lag);
        if (past > 0.0 && past <= arc.exit_angle - arc.entry_angle) sum.add(disc);
      }
    }
    return sum.force;
  }
  const bool gathered = edges.variation().with_chip();
  std::vector<Regime> regimes;
  const auto add_interval = [&](double z1, double z2) {
    for (const EdgePiece& piece : edges.pieces()) {
      const double from = std::max(z1, piece.bottom);
      const double to = std::min(z2, piece.top);
      if (from >= to) continue;
      find_regimes(edges, law_, feed, flute, piece, tip_angle, from, to, regimes);
      for (const Regime& regime : regimes) {
        const auto add = [&](const EdgeNode& node) { sum.add(node); };
        if (gathered) {
          for_each_gathered_node(edges, piece, tangent, regime.bottom, regime.top, add);
        } else {
          edges.for_each_node(piece, tangent, regime.bottom, regime.top, add);
        }
      }
    }
  };
  for (const Arc& arc : arcs) {
    for_each_engaged_interval(edges, tangent, arc, tip_angle, add_interval);
  }
  return sum.force;
}

}  // namespace millstudy::force
