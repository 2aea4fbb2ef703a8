// SPDX-License-Identifier: MIT
#pragma once

#include "core/quadrature.h"
#include "force/edge.h"

namespace millstudy::force {

/// Calls visit(node) for z1 .. z2 with nodes that gather at both ends: p = s^4 (35 - 84 s + 70 s^2
/// - 20 s^3) has three derivatives of zero there, which takes the root out of h^(1-m) at h = 0.
template <class Visit>
void for_each_gathered_node(const CuttingEdges& edges, const EdgePiece& piece, double tangent,
                            double z1, double z2, const Visit& visit) {
  constexpr int kNodes = 40;
  const core::GaussRule& rule = core::gauss_legendre(kNodes);
  const double p1 = CuttingEdges::variable(piece, z1);
  const double length = CuttingEdges::variable(piece, z2) - p1;
  for (int i = 0; i < kNodes; ++i) {
    const double s = 0.5 + 0.5 * rule.nodes[i];
    const double s3 = s * s * s;
    const double part = s3 * s * (35.0 - s * (84.0 - s * (70.0 - 20.0 * s)));
    const double density = 140.0 * s3 * (1.0 - s) * (1.0 - s) * (1.0 - s);
    visit(edges.node(piece, tangent, p1 + length * part, 0.5 * rule.weights[i] * length * density));
  }
}

}  // namespace millstudy::force
