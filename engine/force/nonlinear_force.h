// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <span>

#include "force/chip_law.h"
#include "force/coefficients.h"
#include "force/edge.h"
#include "force/engagement.h"
#include "force/slice.h"

namespace millstudy::force {

/// Force of cuts that are not linear in feed: runout, whose teeth may miss their cut; coefficients
/// that depend on the chip; a climbing feed, which leaves the tool's lower edge without chip.
///
/// (F24): the integral of (F2), (F4) with the chip of (F22), by Gauss-Legendre between the points
/// where the chip law changes. Holds for linear cuts too and agrees with force_basis() there to
/// 1e-13 of the peak; against adaptive quadrature 1e-10 (measured).
class NonlinearForce {
 public:
  NonlinearForce(std::shared_ptr<const CuttingEdges> edges, const EdgeRule& edge_rule)
      : edges_(std::move(edges)), edge_rule_(edge_rule), law_(*edges_) {}

  /// Rows x, y, z, torque, or moments, of one flute in feed axes; shape (4).
  ///
  /// @param tip_angle  immersion angle of the flute's edge at z = 0 [rad], any
  std::array<double, kRows> of_flute(int flute, double tip_angle, std::span<const Arc> arcs,
                                     const Coefficients& coefficients, const Feed& feed,
                                     Rows rows) const;

  const ChipLaw& law() const { return law_; }

 private:
  struct Sum;
  std::shared_ptr<const CuttingEdges> edges_;
  EdgeRule edge_rule_;
  ChipLaw law_;
};

}  // namespace millstudy::force
