// SPDX-License-Identifier: MIT
#include <ceres/ceres.h>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>

#include "cutter/cutter.h"
#include "identify/joint_problem.h"
#include "identify/scaled_eigen.h"

namespace millstudy::identify {
namespace {

/// Residuals and Jacobian of a record, no more rows than columns and one: the same least squares.
///
/// (I5): with J^T J = A^T A, residuals b = A^-T J^T r and the rest of r^T r, which no step changes,
/// give every cost, gradient and Gauss-Newton step of r and J.
struct Compressed {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
};

Compressed compress(const NormalEquations& sums) {
  const Eigen::Index count = sums.gradient.size();
  const ScaledEigen eigen = scaled_eigen(sums.gram);
  Compressed out{Eigen::VectorXd::Zero(count + 1), Eigen::MatrixXd::Zero(count + 1, count)};
  const Eigen::VectorXd turned =
      eigen.vectors.transpose() * eigen.scale.cwiseProduct(sums.gradient);
  const double least = static_cast<double>(count) * 1e-15;
  double explained = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (eigen.values[i] < least) continue;
    const double root = std::sqrt(eigen.values[i]);
    out.residual[i] = turned[i] / root;
    out.jacobian.row(i) = root * eigen.vectors.col(i).cwiseQuotient(eigen.scale).transpose();
    explained += out.residual[i] * out.residual[i];
  }
  out.residual[count] = std::sqrt(std::max(0.0, sums.squares - explained));
  return out;
}

/// The parameters as Ceres moves them, and what all records make of them.
class Evaluation : public ceres::EvaluationCallback {
 public:
  Evaluation(const JointProblem& problem, std::vector<double>& shared,
             std::vector<std::vector<double>>& own)
      : problem_(problem), shared_(shared), own_(own), compressed_(problem.records()) {}

  std::vector<RecordState> states() const {
    std::vector<RecordState> states = problem_.states();
    for (std::size_t r = 0; r < states.size(); ++r) {
      for (std::size_t i = 0; i < shared_.size(); ++i) {
        value_of(states[r], problem_.shared()[i]) = shared_[i];
      }
      for (std::size_t i = 0; i < own_[r].size(); ++i) {
        value_of(states[r], problem_.own()[i]) = own_[r][i];
      }
    }
    return states;
  }

  void PrepareForEvaluation(bool /*jacobians*/, bool new_point) override {
    if (!new_point) return;
    const std::vector<RecordState> all = states();
    tbb::parallel_for(std::size_t{0}, problem_.records(),
                      [&](std::size_t r) { compressed_[r] = compress(problem_.sum(r, all[r])); });
  }

  const Compressed& of(std::size_t record) const { return compressed_[record]; }

 private:
  const JointProblem& problem_;
  std::vector<double>& shared_;
  std::vector<std::vector<double>>& own_;
  std::vector<Compressed> compressed_;
};

/// One record as Ceres sees it.
class RecordCost : public ceres::CostFunction {
 public:
  RecordCost(const Evaluation& evaluation, std::size_t record, std::size_t shared, std::size_t own)
      : evaluation_(evaluation), record_(record) {
    set_num_residuals(static_cast<int>(shared + own) + 1);
    for (const std::size_t size : {shared, own}) {
      if (size > 0) mutable_parameter_block_sizes()->push_back(static_cast<int>(size));
    }
  }

  bool Evaluate(const double* const* /*parameters*/, double* residuals,
                double** jacobians) const override {
    const Compressed& of = evaluation_.of(record_);
    if (!of.residual.allFinite() || !of.jacobian.allFinite()) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = of.residual;
    if (jacobians == nullptr) return true;
    Eigen::Index column = 0;
    for (std::size_t block = 0; block < parameter_block_sizes().size(); ++block) {
      const Eigen::Index size = parameter_block_sizes()[block];
      if (jacobians[block] != nullptr) {
        using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        Eigen::Map<RowMajor>(jacobians[block], num_residuals(), size) =
            of.jacobian.middleCols(column, size);
      }
      column += size;
    }
    return true;
  }

 private:
  const Evaluation& evaluation_;
  std::size_t record_;
};

/// (I10): a normal prior, in the units of the residuals.
class PriorCost : public ceres::CostFunction {
 public:
  PriorCost(int size, int index, double mean, double weight)
      : index_(index), mean_(mean), weight_(weight) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(size);
  }
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    residuals[0] = weight_ * (parameters[0][index_] - mean_);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      std::fill_n(jacobians[0], parameter_block_sizes()[0], 0.0);
      jacobians[0][index_] = weight_;
    }
    return true;
  }

 private:
  int index_;
  double mean_;
  double weight_;
};

/// Tells how far the solver is, and stops it.
class Watch : public ceres::IterationCallback {
 public:
  Watch(const FitSettings& settings, double residuals)
      : settings_(settings), residuals_(residuals) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (settings_.progress) {
      settings_.progress(summary.iteration, std::sqrt(2.0 * summary.cost / residuals_));
    }
    return settings_.stop && *settings_.stop ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const FitSettings& settings_;
  double residuals_;
};

std::vector<double> values(const RecordState& state, const std::vector<Parameter>& parameters) {
  std::vector<double> out;
  for (const Parameter& p : parameters) out.push_back(value_of(state, p));
  return out;
}

}  // namespace

JointProblem::Outcome JointProblem::solve(double prior_noise) {
  std::vector<double> shared = values(states_.front(), shared_);
  std::vector<std::vector<double>> own;
  for (const RecordState& state : states_) own.push_back(values(state, own_));
  Evaluation evaluation(*this, shared, own);

  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &evaluation;
  ceres::Problem problem(problem_options);
  const auto bound = [&](double* block, const std::vector<Parameter>& parameters,
                         std::size_t record) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const Bounds bounds =
          bounds_of(parameters[i], states_[record], records_[record], settings_.runout_limit);
      if (std::isinf(bounds.high)) continue;
      problem.SetParameterLowerBound(block, static_cast<int>(i), bounds.low);
      problem.SetParameterUpperBound(block, static_cast<int>(i), bounds.high);
    }
  };
  for (std::size_t r = 0; r < records(); ++r) {
    std::vector<double*> blocks;
    if (!shared.empty()) blocks.push_back(shared.data());
    if (!own[r].empty()) blocks.push_back(own[r].data());
    if (blocks.empty()) continue;
    problem.AddResidualBlock(new RecordCost(evaluation, r, shared.size(), own[r].size()), nullptr,
                             blocks);
    if (!own[r].empty()) bound(own[r].data(), own_, r);
  }
  if (!shared.empty()) bound(shared.data(), shared_, 0);
  if (prior_noise > 0.0) {
    for (std::size_t i = 0; i < shared_.size(); ++i) {
      if (shared_[i].kind != Parameter::Kind::coefficient || shared_[i].index >= 6) continue;
      const Known& known = settings_.known[shared_[i].index];
      if (!known.mean) continue;
      problem.AddResidualBlock(new PriorCost(static_cast<int>(shared.size()), static_cast<int>(i),
                                             *known.mean, prior_noise / *known.deviation),
                               nullptr, shared.data());
    }
  }

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;  // rows are few after (I5)
  options.max_num_iterations = settings_.max_iterations;
  options.function_tolerance = settings_.tolerance;
  options.parameter_tolerance = 1e-3 * settings_.tolerance;
  options.gradient_tolerance = 0.0;
  options.logging_type = ceres::SILENT;
  double residuals = 0.0;
  for (const RecordModel& model : models_) {
    residuals += static_cast<double>(model.axes().size() * model.residuals());
  }
  Watch watch(settings_, residuals);
  options.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (settings_.stop && *settings_.stop) throw Stopped("the fit was stopped");
  states_ = evaluation.states();
  return {summary.termination_type == ceres::CONVERGENCE,
          static_cast<int>(summary.iterations.size()), summary.final_cost, summary.message};
}

}  // namespace millstudy::identify
