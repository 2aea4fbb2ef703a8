// SPDX-License-Identifier: MIT
#include "force/force_basis.h"

#include <cmath>

#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// (F12): the discs of one tooth whose middle is in the material.
void add_discs(ForceBasis& basis, const CuttingEdges& edges, const Arc& arc, int discs, int flute,
               double tip_angle) {
  const double tangent = edges.flutes()[flute].helix_tangent;
  const double width = arc.exit_angle - arc.entry_angle;
  for (int i = 0; i < discs; ++i) {
    const EdgeNode disc = edges.disc(tangent, discs, i);
    const double phi = tip_angle - tangent * disc.lag;
    const double past = angle_past_first_limit(tangent, arc, phi);
    if (!(past > 0.0 && past <= width)) continue;
    add_node(basis, edges, Rows::forces, flute, disc, std::sin(phi), std::cos(phi));
  }
}

}  // namespace

ForceBasis force_basis(const cutter::Cutter& cutter, const Engagement& engagement,
                       const EdgeRule& edge_rule, double phi, const Variation& variation) {
  cutter::check(cutter);
  check(cutter, engagement);
  check(edge_rule);
  check(variation);
  const CuttingEdges edges(cutter, engagement.axial_depth, variation);
  const Arc arc = engagement.arc();
  ForceBasis basis;
  for (int flute = 0; flute < cutter.flutes; ++flute) {
    const double tip_angle = phi + edges.flutes()[flute].position;  // (F5) at z = 0
    if (edge_rule.rule == Rule::discs) {
      add_discs(basis, edges, arc, edge_rule.discs, flute, tip_angle);
      continue;
    }
    for_each_engaged_interval(
        edges, edges.flutes()[flute].helix_tangent, arc, tip_angle,
        [&](double z1, double z2) { add_edge(basis, edges, flute, tip_angle, z1, z2); });
  }
  return basis;
}

std::array<double, kRows> evaluate(const ForceBasis& basis, const Coefficients& coefficients,
                                   const Feed& feed) {
  return force_of(basis, loads(coefficients, feed));
}

}  // namespace millstudy::force
