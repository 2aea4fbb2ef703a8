// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "force/edge.h"
#include "force/engagement.h"
#include "force/prepared_edges.h"
#include "force/sampling_run.h"

namespace millstudy::force {

/// The edges of a cutter with runout, in the fastest way that its axes and helix angles allow.
class RunoutEdges {
 public:
  /// None where no way serves: without runout, under coefficients that depend on the chip, by
  /// discs, of more teeth or pieces than is worth it.
  /// @param edges        of the cutter as it is
  /// @param plain_edges  without what pitch does to it
  RunoutEdges(const CuttingEdges& edges, const CuttingEdges& plain_edges, Rows rows,
              const EdgeRule& edge_rule);

  /// Only for feeds in the plane.
  bool serve(const Feed& feed) const;

  /// Adds flutes first .. last.
  /// @param edges  of the cutter as it is
  void add_to(SamplingRun& run, const CuttingEdges& edges, int first, int last,
              const Coefficients& k, const Feed& feed, std::span<const Arc> arcs) const;

 private:
  std::vector<RunoutEdge> parallel_;
  std::vector<TiltedEdge> tilted_;
  std::vector<ReachEdge> unlike_;  ///< of helix angles that differ, parallel or not
};

}  // namespace millstudy::force
