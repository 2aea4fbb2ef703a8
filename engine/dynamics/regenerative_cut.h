// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "dynamics/delay_system.h"
#include "dynamics/swept_arc.h"
#include "force/coefficients.h"
#include "force/edge.h"
#include "force/engagement.h"
#include "force/tooth_integral.h"

namespace millstudy::dynamics {

/// The force that vibration adds to a cut, dF = -A (u(t) - u(t - tau)), (D5).
///
/// A is 2 x 2 [N/mm], rows and columns x, y. Of coefficients that do not depend on the chip and
/// cutters without runout, whose every tooth is in cut.
class RegenerativeCut {
 public:
  /// Throws core::InputError for a cutter, engagement or coefficients out of range.
  RegenerativeCut(const cutter::Cutter& cutter, const force::Engagement& engagement,
                  const force::Coefficients& coefficients, const force::Variation& variation = {});

  const force::CuttingEdges& edges() const { return *edges_; }
  force::Arc arc() const { return swept_.arc(); }
  /// Period of A over the spindle angle [rad]: the pitch of equal flutes, else a turn.
  double period_angle() const;

  /// (D6): A of one flute at one angle of its tip [rad]; exact to rounding.
  Eigen::Matrix2d stiffness(int flute, double tip_angle) const;

  /// (D7): the integral over the angle of the tip of (D6) between two heights, from some fixed
  /// angle to this one [N rad/mm]; differences over an interval give exact averages.
  Eigen::Matrix2d swept(int flute, double tip_angle, double z1, double z2) const;

  /// (D7) at so many equally spaced angles; shape (count).
  std::vector<Eigen::Matrix2d> swept(int flute, double first_angle, double step, int count,
                                     double z1, double z2) const;

  /// Angle from a flute to the one before it at a lag per tangent [rad]: the delay is that over the
  /// spindle speed.
  double pitch(int flute, double lag) const;

  /// (D26): its process damping, whose matrices stand in the place of A [N s/mm].
  /// @param coefficient  C over the cutting speed [N s/mm2]
  RegenerativeCut process_damping(double coefficient) const;

  /// A averaged over a turn [N/mm], all flutes: that of the zeroth-order solution (D20).
  Eigen::Matrix2d mean_stiffness() const;

  /// Calls visit(lag per tangent, stiffness) for the nodes of a flute in cut: (D6) one by one.
  template <class Visit>
  void for_each_node(int flute, double tip_angle, const Visit& visit) const {
    const auto add = [&](double z1, double z2) {
      for (const force::EdgePiece& piece : edges_->pieces()) {
        const double from = std::max(z1, piece.bottom), to = std::min(z2, piece.top);
        if (from < to) for_each_node_of(flute, piece, tip_angle, from, to, visit);
      }
    };
    force::for_each_engaged_interval(*edges_, edges_->flutes()[flute].helix_tangent, swept_.arc(),
                                     tip_angle, add);
  }

 private:
  struct Weights {
    double tangential;  ///< Ktc dz [N/mm]
    double radial;      ///< (Krc sin(kappa) + Kac cos(kappa)) dz [N/mm]
  };
  template <class Visit>
  void for_each_node_of(int flute, const force::EdgePiece& piece, double tip_angle, double z1,
                        double z2, const Visit& visit) const {
    const double tangent = edges_->flutes()[flute].helix_tangent;
    edges_->for_each_node(piece, tangent, z1, z2, [&](const force::EdgeNode& node) {
      const double twice = 2.0 * (tip_angle - tangent * node.lag);
      const auto [t, r] = weights(flute, node);
      visit(node.lag, directional(t, r, {1.0, std::cos(twice), std::sin(twice)}));
    });
  }
  Weights weights(int flute, const force::EdgeNode& node) const;
  bool has_closed_form(int flute, const force::EdgePiece& piece, double z1, double z2) const;
  Eigen::Matrix2d swept_nodes(int flute, const force::EdgePiece& piece, double tip_angle, double z1,
                              double z2) const;

  std::shared_ptr<const force::CuttingEdges> edges_;
  SweptArc swept_;
  force::Coefficients coefficients_;
};

/// (D8): a machine that cuts, as a system with delays.
///
/// Variable helix, whose delays vary along the edge: at() has a delay for each node of the edge,
/// averages() cuts the edge into slices of which each has the delay of its middle, the finer the
/// more intervals.
/// @param spindle_speed    [rad/s], > 0; throws core::InputError otherwise
/// @param process_damping  C of (D26) [N/mm], >= 0
DelaySystem delay_system(const Machine& machine, const RegenerativeCut& cut, double spindle_speed,
                         double process_damping = 0.0);

}  // namespace millstudy::dynamics
