// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "identify/record_model.h"

namespace millstudy::identify {

/// What least squares needs of one record: sums over its samples, in the order of the parameters,
/// shared ones first.
struct NormalEquations {
  Eigen::MatrixXd gram;      ///< J^T J
  Eigen::VectorXd gradient;  ///< J^T r
  double squares = 0.0;      ///< r^T r
};

/// All records of a fit with the state that each is in.
class JointProblem {
 public:
  /// @param states  one for each record; what is shared must agree
  JointProblem(const cutter::Cutter& cutter, const std::vector<Record>& records,
               const FitSettings& settings, std::vector<RecordState> states);

  const std::vector<Parameter>& shared() const { return shared_; }
  const std::vector<Parameter>& own() const { return own_; }
  const std::vector<RecordState>& states() const { return states_; }
  const RecordModel& model(std::size_t record) const { return models_[record]; }
  std::size_t records() const { return models_.size(); }
  const FitSettings& settings() const { return settings_; }
  /// What residuals of a record are multiplied with, so that records count alike if they should.
  double weight(std::size_t record) const { return weights_[record]; }

  /// From here on only the own parameters of the records are estimated.
  void keep_shared() { shared_.clear(); }

  /// The shared and the own parameters of a record, one after the other.
  std::vector<Parameter> parameters() const;

  /// Replaces the residual and the Jacobian of a stretch by weighted, robust ones, (I6).
  void weigh(std::size_t record, Stretch& stretch) const;

  /// Sums over one record.
  NormalEquations sum(std::size_t record, const RecordState& state) const;

  struct Outcome {
    bool converged = false;
    int iterations = 0;
    double cost = 0.0;
    std::string summary;
  };
  /// Moves the states to the least cost nearby, by Levenberg-Marquardt (Ceres).
  ///
  /// @param prior_noise  standard deviation [N] that residuals are weighed with against priors
  ///                     (I10); 0: no priors
  Outcome solve(double prior_noise = 0.0);

 private:
  cutter::Cutter cutter_;
  const std::vector<Record>& records_;
  FitSettings settings_;
  std::vector<Parameter> shared_;
  std::vector<Parameter> own_;
  std::vector<RecordModel> models_;
  std::vector<RecordState> states_;
  std::vector<double> weights_;
};

}  // namespace millstudy::identify
