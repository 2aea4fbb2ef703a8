// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace millstudy::identify {

/// S M S = V diag(values) V^T with S = diag(scale): a symmetric matrix without the units of its
/// parameters.
struct ScaledEigen {
  Eigen::VectorXd scale;    ///< one over the root of the diagonal, 1 where that is zero
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< by column, of unit length
};

/// @param matrix  shape (n, n), symmetric, n >= 1; negative numbers on the diagonal count as zero
ScaledEigen scaled_eigen(const Eigen::MatrixXd& matrix);

}  // namespace millstudy::identify
