// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "cutter/flutes.h"
#include "force/chip_law.h"
#include "force/edge.h"
#include "force/engagement.h"

namespace millstudy::dynamics {

/// Discs of all edges of a cutter, each with the teeth before it: what a simulation sums over.
class SimulatedEdge {
 public:
  /// One tooth that passed the same place before.
  struct Before {
    double angle;  ///< of the spindle since then [rad]
    double ahead;  ///< radius of this tooth less radius of that one [mm]
  };
  struct Disc {
    double tip;  ///< position of the disc less its lag: angle at spindle angle 0 [rad]
    double sin_kappa, cos_kappa;
    double width;                   ///< db [mm]
    double length;                  ///< dS [mm]
    std::array<double, 6> factors;  ///< of the coefficients
    std::vector<Before> before;     ///< nearest first
  };

  /// @param slices  of each piece of the envelope below the depth; 0: as many as it needs
  /// @param turns  of teeth before
  SimulatedEdge(const force::CuttingEdges& edges, int slices, int turns, bool all_before);

  const std::vector<Disc>& discs() const { return discs_; }

 private:
  std::vector<Disc> discs_;
};

}  // namespace millstudy::dynamics
