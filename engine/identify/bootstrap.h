// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "identify/joint_problem.h"

namespace millstudy::identify {

/// (I13): what the shared parameters become when the residuals of whole revolutions, drawn with
/// replacement from each record, are put on its predicted forces and all is fitted again.
///
/// Samples run in parallel, each with a seed of its own: the same bit for bit for any number of
/// threads.
/// @param solved       at its optimum
/// @param prior_noise  as for JointProblem::solve()
/// @return values of the shared parameters, shape (settings.bootstrap, shared)
std::vector<std::vector<double>> bootstrap(const cutter::Cutter& cutter,
                                           const std::vector<Record>& records,
                                           const JointProblem& solved, double prior_noise);

/// Standard deviation, 2.5 % and 97.5 % point of values.
struct Spread {
  double deviation = 0.0;
  double low = 0.0;
  double high = 0.0;
};
Spread spread(std::vector<double> values);

}  // namespace millstudy::identify
