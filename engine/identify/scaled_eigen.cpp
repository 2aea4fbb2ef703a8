// SPDX-License-Identifier: MIT
#include "identify/scaled_eigen.h"

#include <Eigen/Eigenvalues>

namespace millstudy::identify {

ScaledEigen scaled_eigen(const Eigen::MatrixXd& matrix) {
  Eigen::VectorXd scale = matrix.diagonal().cwiseMax(0.0).cwiseSqrt();
  for (double& s : scale) s = s > 0.0 ? 1.0 / s : 1.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * matrix *
                                                             scale.asDiagonal());
  return {scale, eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace millstudy::identify
