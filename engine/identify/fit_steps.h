// SPDX-License-Identifier: MIT
#pragma once

#include "identify/joint_problem.h"

/// What fit() consists of.
namespace millstudy::identify {

/// Throws core::InputError with every fault of records and settings.
void check(const cutter::Cutter& cutter, const std::vector<Record>& records,
           const FitSettings& settings);

/// Where the search begins: each record at its own optimum, what is shared at the middle of them.
std::vector<RecordState> find_starts(const cutter::Cutter& cutter,
                                     const std::vector<Record>& records,
                                     const FitSettings& settings);

/// A problem at its optimum, and how it got there.
struct Solved {
  JointProblem problem;
  JointProblem::Outcome outcome;
  double prior_noise = 0.0;  ///< see JointProblem::solve()
};

/// In steps of more and more parameters, so that each begins where the model is nearly right.
///
/// @param records  must outlive what is returned
Solved solve(const cutter::Cutter& cutter, const std::vector<Record>& records,
             const FitSettings& settings, const std::vector<RecordState>& starts);

/// R^2 and root mean square error of a record, with its forces where they are wanted.
Agreement agreement_of(const JointProblem& problem, std::size_t record,
                       std::array<std::vector<double>, 3>* predicted = nullptr);

/// What is found without each of the records in turn.
struct LeaveOneOut {
  std::vector<std::vector<double>> shared;  ///< values of the shared parameters, by record left out
  std::vector<Agreement> agreement;         ///< with the record left out
  double prediction_error;                  ///< see FitResult
};

/// (I9). Of three records or more.
LeaveOneOut leave_one_out(const cutter::Cutter& cutter, const std::vector<Record>& records,
                          const FitSettings& settings, const std::vector<RecordState>& solved);

/// Plain words about what the data cannot tell apart, and what to measure next.
std::vector<std::string> words_on(const std::vector<Record>& records, const FitResult& result,
                                  const std::vector<Parameter>& shared,
                                  const Eigen::VectorXd& weakest);

}  // namespace millstudy::identify
