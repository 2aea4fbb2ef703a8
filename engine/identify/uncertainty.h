// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/joint_problem.h"

namespace millstudy::identify {

/// How sure the parameters of a solved problem are, (I8).
struct Uncertainty {
  Eigen::MatrixXd shared_covariance;       ///< of the shared parameters; that of correlated noise
  Eigen::VectorXd shared_naive;            ///< standard errors as if residuals were white
  std::vector<Eigen::VectorXd> own_error;  ///< standard errors by record
  std::vector<Eigen::VectorXd> own_naive;
  double degrees_of_freedom = 0.0;  ///< of Student's t for the intervals
  double noise = 0.0;               ///< root mean square residual, freedom taken off [N]
  double correlation = 0.0;         ///< of neighbouring residuals
  double condition_number = 0.0;    ///< of the coefficients' columns at unit length, (I7)
  Eigen::VectorXd weakest;  ///< the combination of coefficients that is known least, unit length
};

/// Linearised at the states of the problem: residuals are taken together by revolutions, whatever
/// their correlation within, and what each leaves out moves the parameters by is squared.
///
/// @param prior_noise  as for JointProblem::solve()
Uncertainty uncertainty(const JointProblem& problem, double prior_noise);

}  // namespace millstudy::identify
