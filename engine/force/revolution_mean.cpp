// SPDX-License-Identifier: MIT
#include "force/revolution_mean.h"

#include <cmath>

#include "core/quadrature.h"
#include "core/units.h"
#include "force/tooth_integral.h"

namespace millstudy::force {

ForceBasis revolution_mean(const cutter::Cutter& cutter, const Engagement& engagement) {
  check(cutter, engagement);
  const CuttingEdges edges(cutter, engagement.axial_depth, {});
  // Every point of an edge passes every angle of the cut once, whatever its lag, so that the
  // integrals over angle and height separate. That over the angle is of degree 2 in sin and cos.
  const core::GaussRule& angles = core::gauss_legendre(20);
  const double middle = 0.5 * (engagement.entry_angle + engagement.exit_angle);
  const double half = 0.5 * (engagement.exit_angle - engagement.entry_angle);
  ForceBasis mean;
  for (int flute = 0; flute < static_cast<int>(edges.flutes().size()); ++flute) {
    for (const EdgePiece& piece : edges.pieces()) {
      const auto add = [&](const EdgeNode& node) {
        for (std::size_t i = 0; i < angles.nodes.size(); ++i) {
          const double phi = middle + half * angles.nodes[i];
          EdgeNode part = node;
          const double weight = half * angles.weights[i] / core::kTurn;
          part.width *= weight;
          part.length *= weight;
          add_node(mean, edges, Rows::forces, flute, part, std::sin(phi), std::cos(phi));
        }
      };
      edges.for_each_node(piece, edges.flutes()[flute].helix_tangent, piece.bottom, piece.top, add);
    }
  }
  return mean;
}

}  // namespace millstudy::force
