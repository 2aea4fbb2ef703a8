// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace millstudy::dynamics {

/// The method of Gauss with N stages on 0 .. 1 (J.C. Butcher, Math. Comp. 18 (1964) 50-64).
struct GaussCollocation {
  Eigen::VectorXd nodes;     ///< ascending, shape (N)
  Eigen::VectorXd weights;   ///< sum 1, shape (N)
  Eigen::MatrixXd integral;  ///< of the Lagrange polynomial of node j from 0 to node i, N x N

  /// Weights of the values at 0 and at the nodes in the polynomial through them; shape (N + 1).
  /// Exactly one weight where the place is one of them to 1e-9.
  Eigen::VectorXd interpolation(double place) const;
};

/// The method with N stages, 2 <= N <= 16, made once and kept. Its integrals are exact to 1e-15.
const GaussCollocation& gauss_collocation(int stages);

}  // namespace millstudy::dynamics
