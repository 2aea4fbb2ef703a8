// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "dynamics/state_space.h"

namespace millstudy::dynamics {

/// (D10): how a state goes on over an interval of constant gain under a force that is a polynomial:
/// s(h) = exp s(0) + sum over k of drive[k] f_k for the force sum of f_k (t/h)^k.
struct IntervalStep {
  Eigen::MatrixXd exponential;           ///< n x n
  std::array<Eigen::MatrixXd, 3> drive;  ///< each n x m, as many as terms
};

/// (D10) for d/dt s = (a - b W c) s - b B u' + b f, u' the velocity.
///
/// Closed form for one mode and a constant force; else the Taylor series with scaling and squaring.
/// Measured against quadruple precision: 4e-15.
/// @param gain      W [N/mm], of which moving x moving count
/// @param duration  h [s], > 0
/// @param terms     1 .. 3
/// @param damping   B [N s/mm]
IntervalStep interval_step(const StateSpace& machine, const Eigen::Matrix2d& gain, double duration,
                           int terms, const Eigen::Matrix2d& damping = Eigen::Matrix2d::Zero());

/// The same of one mode under a constant force, in closed form, for many gains in a row.
class OneModeStep {
 public:
  static bool serves(const StateSpace& machine, int terms);
  OneModeStep(const StateSpace& machine, double duration);

  /// @param out  exponential column by column, then drive; shape (6)
  /// @return false where the gain all but cancels the stiffness: the closed form then loses digits
  bool make(double gain, double* out) const;

 private:
  double w_, damping_, b_, stiffening_, duration_, decay_, decay_less_one_;
};

}  // namespace millstudy::dynamics
