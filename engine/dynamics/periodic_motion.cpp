// SPDX-License-Identifier: MIT
#include "dynamics/periodic_motion.h"

#include <algorithm>
#include <cmath>

#include "dynamics/gauss_collocation.h"

namespace millstudy::dynamics {

PeriodicMotion::PeriodicMotion(double period, std::vector<double> starts, int nodes,
                               std::vector<int> axes, std::vector<double> positions)
    : period_(period),
      starts_(std::move(starts)),
      nodes_(nodes),
      axes_(std::move(axes)),
      positions_(std::move(positions)) {}

PeriodicMotion::PeriodicMotion(double period, std::vector<Eigen::Vector2d> samples)
    : period_(period), samples_(std::move(samples)) {}

Eigen::Vector2d PeriodicMotion::at(double t) const {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  const double rest = std::clamp(t - period_ * std::floor(t / period_), 0.0, period_);
  if (!samples_.empty()) {
    const auto count = static_cast<std::ptrdiff_t>(samples_.size());
    const double share = rest / period_ * static_cast<double>(count);
    const double whole = std::floor(share), x = share - whole;
    const auto sample = [&](std::ptrdiff_t offset) -> const Eigen::Vector2d& {
      return samples_[(static_cast<std::ptrdiff_t>(whole) + offset + count) % count];
    };
    return -x * (x - 1.0) * (x - 2.0) / 6.0 * sample(-1) +
           (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0 * sample(0) -
           (x + 1.0) * x * (x - 2.0) / 2.0 * sample(1) +
           (x + 1.0) * x * (x - 1.0) / 6.0 * sample(2);
  }
  if (starts_.empty()) return place;
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), rest);
  const auto element = std::max<std::ptrdiff_t>(0, next - starts_.begin() - 1);
  const double end = next == starts_.end() ? period_ : *next;
  const double within = (rest - starts_[element]) / (end - starts_[element]);
  const Eigen::VectorXd weights = gauss_collocation(nodes_).interpolation(within);
  const auto moving = static_cast<std::ptrdiff_t>(axes_.size());
  const double* u = positions_.data() + element * (nodes_ + 1) * moving;
  for (int k = 0; k <= nodes_; ++k) {
    for (std::ptrdiff_t i = 0; i < moving; ++i) place[axes_[i]] += weights[k] * u[k * moving + i];
  }
  return place;
}

double PeriodicMotion::largest() const {
  double most = 0.0;
  for (const double u : positions_) most = std::max(most, std::abs(u));
  for (const Eigen::Vector2d& u : samples_) most = std::max(most, u.cwiseAbs().maxCoeff());
  return most;
}

}  // namespace millstudy::dynamics
