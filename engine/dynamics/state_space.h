// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/machine.h"

namespace millstudy::dynamics {

/// (D2): displacement of the tool over force, rows and columns x, y [mm/N].
///
/// Exact to rounding.
/// @param omega  [rad/s], any
Eigen::Matrix2cd frequency_response(const Machine& machine, double omega);

/// (D3): d/dt s = a s + b F, u = c s with F the force [N] and u the displacement [mm] along the
/// axes in which the machine moves.
///
/// The state of a mode is (q, v / omega_n) [mm], so that entries of a are frequencies [rad/s].
struct StateSpace {
  Eigen::MatrixXd a;      ///< n x n, of blocks 2 x 2
  Eigen::MatrixXd b;      ///< n x m
  Eigen::MatrixXd c;      ///< m x n
  std::vector<int> axes;  ///< which of x (0), y (1) the m rows of u and F are

  int states() const { return static_cast<int>(a.rows()); }
  int moving() const { return static_cast<int>(c.rows()); }
  /// m x n: of the velocity d/dt u [mm/s].
  Eigen::MatrixXd velocity() const;
};

/// The state space of a machine; residues of rank one take two states, others four. Exact to
/// rounding. Throws core::InputError as check() does.
StateSpace state_space(const Machine& machine);

}  // namespace millstudy::dynamics
