// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/mode.h"

namespace millstudy::dynamics {

/// A mode that moves along one machine axis. One of mass and stiffness is given, the other zero.
struct AxisMode {
  Mode mode;
  double mass = 0.0;       ///< modal [N s2/mm], 1 kg is 1e-3; > 0, or 0: from the stiffness
  double stiffness = 0.0;  ///< modal [N/mm], > 0, or 0: from the mass
};

/// A mode that couples the axes, by its residue matrix (D2).
struct ResidueMode {
  Mode mode;
  Eigen::Matrix2d residue = Eigen::Matrix2d::Zero();  ///< R [mm/(N s2)], rows and columns x, y
};

/// How the tool moves against the workpiece under a force: modes of either or both sides.
struct Machine {
  std::vector<AxisMode> x;
  std::vector<AxisMode> y;
  std::vector<ResidueMode> coupled;
};

/// Throws core::InputError for a mode out of range, mass and stiffness both or neither, a residue
/// that is not finite or zero, and a machine without modes.
void check(const Machine& machine);

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

/// The state space of a machine; residues of rank one take two states, others four.
StateSpace state_space(const Machine& machine);

}  // namespace millstudy::dynamics
