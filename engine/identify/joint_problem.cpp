// SPDX-License-Identifier: MIT
#include "identify/joint_problem.h"

#include <cmath>
#include <tbb/parallel_for.h>

namespace millstudy::identify {
namespace {

/// rho(s) of a loss in units of its scale, s the squared residual, and its derivative, (I6).
std::pair<double, double> rho(Loss loss, double s) {
  if (loss == Loss::huber && s > 1.0) return {2.0 * std::sqrt(s) - 1.0, 1.0 / std::sqrt(s)};
  if (loss == Loss::cauchy) return {std::log1p(s), 1.0 / (1.0 + s)};
  return {s, 1.0};
}

/// Root mean square of what was measured [N].
double size_of(const RecordModel& model) {
  double squares = 0.0;
  for (const int axis : model.axes()) {
    for (const double f : model.record().trace.force[axis]) squares += f * f;
  }
  const double count = static_cast<double>(model.axes().size() * model.samples());
  return std::sqrt(squares / count);
}

}  // namespace

JointProblem::JointProblem(const cutter::Cutter& cutter, const std::vector<Record>& records,
                           const FitSettings& settings, std::vector<RecordState> states)
    : cutter_(cutter),
      records_(records),
      settings_(settings),
      shared_(shared_parameters(settings)),
      own_(own_parameters(settings)),
      states_(std::move(states)),
      weights_(records.size(), 1.0) {
  models_.reserve(records.size());
  for (const Record& record : records) models_.emplace_back(cutter, record, settings);
  if (!settings.weigh_records_alike) return;
  double mean = 0.0;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    weights_[i] = 1.0 / std::max(size_of(models_[i]), 1e-300);
    mean += weights_[i] / static_cast<double>(models_.size());
  }
  for (double& weight : weights_) weight /= mean;
}

std::vector<Parameter> JointProblem::parameters() const {
  std::vector<Parameter> all = shared_;
  all.insert(all.end(), own_.begin(), own_.end());
  return all;
}

void JointProblem::weigh(std::size_t record, Stretch& stretch) const {
  const double weight = weights_[record];
  if (weight != 1.0) {
    stretch.residual *= weight;
    stretch.jacobian *= weight;
  }
  if (settings_.loss == Loss::none) return;
  for (Eigen::Index i = 0; i < stretch.residual.size(); ++i) {
    const double r = stretch.residual[i] / settings_.loss_scale;
    const auto [value, slope] = rho(settings_.loss, r * r);
    if (r == 0.0) continue;
    const double root = std::sqrt(value);
    stretch.residual[i] = std::copysign(root, r) * settings_.loss_scale;
    stretch.jacobian.row(i) *= slope * std::abs(r) / root;
  }
}

NormalEquations JointProblem::sum(std::size_t record, const RecordState& state) const {
  const std::vector<Parameter> all = parameters();
  const auto count = static_cast<Eigen::Index>(all.size());
  NormalEquations sums{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
  models_[record].for_each_stretch(state, all, [&](Stretch& stretch) {
    weigh(record, stretch);
    sums.gram.selfadjointView<Eigen::Lower>().rankUpdate(stretch.jacobian.transpose());
    sums.gradient.noalias() += stretch.jacobian.transpose() * stretch.residual;
    sums.squares += stretch.residual.squaredNorm();
  });
  sums.gram.triangularView<Eigen::StrictlyUpper>() = sums.gram.transpose();
  return sums;
}

}  // namespace millstudy::identify
