// SPDX-License-Identifier: MIT
#include "force/runout_edges.h"

#include "core/watch.h"
#include "cutter/flutes.h"

namespace millstudy::force {

RunoutEdges::RunoutEdges(const CuttingEdges& edges, const CuttingEdges& plain_edges, Rows rows,
                         const EdgeRule& edge_rule) {
  const cutter::Cutter& cutter = edges.cutter();
  if (!cutter::has_runout(cutter) || edges.variation().with_chip() ||
      edge_rule.rule != Rule::exact || cutter.flutes > RunoutEdge::kMostFlutes) {
    return;
  }
  if (!edges.variable_helix()) {
    for (const EdgePiece& piece : plain_edges.pieces()) {
      if (cutter.runout.tilt == 0.0) {
        parallel_.emplace_back(plain_edges, rows, piece);
      } else {
        tilted_.emplace_back(plain_edges, rows, piece);
      }
    }
    return;
  }
  // Every pair of flutes has its series of every piece: some 20 us and 10 kB.
  constexpr std::size_t kMostPairs = 2000;
  const std::size_t flutes = cutter.flutes;
  if (flutes * flutes * edges.pieces().size() > kMostPairs) return;
  for (const EdgePiece& piece : edges.pieces()) {
    for (int flute = 0; flute < cutter.flutes; ++flute) {
      core::keep_watch();
      unlike_.emplace_back(edges, rows, flute, piece);
    }
  }
}

bool RunoutEdges::serve(const Feed& feed) const {
  return feed.slope == 0.0 && !(parallel_.empty() && tilted_.empty() && unlike_.empty());
}

void RunoutEdges::add_to(SamplingRun& run, const CuttingEdges& edges, int first, int last,
                         const Coefficients& k, const Feed& feed, std::span<const Arc> arcs) const {
  for (const RunoutEdge& edge : parallel_) edge.add_to(run, edges, first, last, k, feed, arcs);
  for (const TiltedEdge& edge : tilted_) edge.add_to(run, edges, first, last, k, feed, arcs);
  for (const ReachEdge& edge : unlike_) {
    if (edge.flute() >= first && edge.flute() <= last) edge.add_to(run, k, feed, arcs);
  }
}

}  // namespace millstudy::force
