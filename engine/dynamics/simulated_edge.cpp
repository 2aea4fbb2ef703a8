// SPDX-License-Identifier: MIT
#include "dynamics/simulated_edge.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace millstudy::dynamics {

namespace {

/// Slices of a piece: none lags by more than 5 deg, turns by more than 3 deg of kappa or, where
/// coefficients vary with height, is more than a tenth of it.
int slices_of(const force::CuttingEdges& edges, const force::EdgePiece& piece) {
  double steepest = 0.0;
  for (const cutter::Flute& flute : edges.flutes()) {
    steepest = std::max(steepest, std::abs(flute.helix_tangent));
  }
  const cutter::Envelope& envelope = edges.envelope();
  const double lag = steepest * (envelope.lag(piece.top) - envelope.lag(piece.bottom));
  const double turn = piece.segment.is_arc
                          ? piece.segment.kappa_at(piece.top) - piece.segment.kappa_at(piece.bottom)
                          : 0.0;
  const bool plain = piece.segment.is_cylinder() && !edges.variation().with_height();
  const double slices =
      std::max(lag / core::rad_from_deg(5.0), std::abs(turn) / core::rad_from_deg(3.0));
  return std::clamp(static_cast<int>(std::ceil(slices)), plain ? 1 : 10, 400);
}

}  // namespace

SimulatedEdge::SimulatedEdge(const force::CuttingEdges& edges, int slices, int turns,
                             bool all_before) {
  const auto flutes = static_cast<int>(edges.flutes().size());
  const cutter::Runout& runout = edges.cutter().runout;
  const auto add = [&](int j, const force::EdgeNode& node) {
    const auto position = [&](int m) {  // of flute j + m, turns included
      const cutter::Flute& flute = edges.flutes()[(j + m) % flutes];
      return flute.position - flute.helix_tangent * node.lag + core::kTurn * ((j + m) / flutes);
    };
    const double own = position(0);
    Disc disc{own, node.sin_kappa, node.cos_kappa, node.width, node.length, edges.factors(j, node),
              {}};
    const int most = all_before ? turns * flutes : 1;
    for (int m = 1; m <= most; ++m) {
      const double other = position(m);
      disc.before.push_back({other - own, cutter::runout_at(runout, own, node.z) -
                                              cutter::runout_at(runout, other, node.z)});
    }
    discs_.push_back(disc);
  };
  for (int j = 0; j < flutes; ++j) {
    for (const force::EdgePiece& piece : edges.pieces()) {
      const int count = slices > 0 ? slices : slices_of(edges, piece);
      // Equal steps of the variable in which nothing is singular (C11), at their middles.
      const double first = force::CuttingEdges::variable(piece, piece.bottom);
      const double step = (force::CuttingEdges::variable(piece, piece.top) - first) / count;
      for (int i = 0; i < count; ++i) {
        add(j, edges.node(piece, edges.flutes()[j].helix_tangent, first + (i + 0.5) * step, step));
      }
    }
  }
}

}  // namespace millstudy::dynamics
