// SPDX-License-Identifier: MIT
#include "dynamics/state_space.h"

#include <Eigen/SVD>
#include <complex>

namespace millstudy::dynamics {
namespace {

/// One equation q'' + 2 zeta omega q' + omega^2 q = in . F that moves the tool by out q.
struct Oscillator {
  Mode mode;
  Eigen::Vector2d out;
  Eigen::Vector2d in;  // [mm/(N s2)]
};

Eigen::Matrix2d matrix(const std::array<double, 4>& residue) {
  return Eigen::Matrix<double, 2, 2, Eigen::RowMajor>(residue.data());
}

double inverse_mass(const AxisMode& m) {
  if (m.mass > 0.0) return 1.0 / m.mass;
  return m.mode.natural_frequency * m.mode.natural_frequency / m.stiffness;
}

std::vector<Oscillator> oscillators(const Machine& machine) {
  std::vector<Oscillator> all;
  const auto add_axis = [&](const std::vector<AxisMode>& modes, const Eigen::Vector2d& axis) {
    for (const AxisMode& m : modes) all.push_back({m.mode, axis, inverse_mass(m) * axis});
  };
  add_axis(machine.x, Eigen::Vector2d::UnitX());
  add_axis(machine.y, Eigen::Vector2d::UnitY());
  for (const ResidueMode& m : machine.coupled) {
    const Eigen::JacobiSVD<Eigen::Matrix2d> svd(matrix(m.residue),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    for (int i = 0; i < 2; ++i) {
      const double value = svd.singularValues()[i];
      if (value <= 1e-12 * svd.singularValues()[0]) continue;
      all.push_back({m.mode, svd.matrixU().col(i), value * svd.matrixV().col(i)});
    }
  }
  return all;
}

}  // namespace

Eigen::Matrix2cd frequency_response(const Machine& machine, double omega) {
  Eigen::Matrix2cd response = Eigen::Matrix2cd::Zero();
  const auto factor = [&](const Mode& mode) {
    const double w = mode.natural_frequency;
    return 1.0 / std::complex<double>(w * w - omega * omega, 2.0 * mode.damping_ratio * w * omega);
  };
  for (const AxisMode& m : machine.x) response(0, 0) += inverse_mass(m) * factor(m.mode);
  for (const AxisMode& m : machine.y) response(1, 1) += inverse_mass(m) * factor(m.mode);
  for (const ResidueMode& m : machine.coupled) response += factor(m.mode) * matrix(m.residue);
  return response;
}

Eigen::MatrixXd StateSpace::velocity() const {
  Eigen::MatrixXd v = Eigen::MatrixXd::Zero(c.rows(), c.cols());
  for (Eigen::Index q = 0; q < c.cols(); q += 2) v.col(q + 1) = a(q, q + 1) * c.col(q);
  return v;
}

StateSpace state_space(const Machine& machine) {
  check(machine);
  const std::vector<Oscillator> all = oscillators(machine);
  StateSpace space;
  for (int axis = 0; axis < 2; ++axis) {
    bool moves = false;
    for (const Oscillator& o : all) moves = moves || o.out[axis] != 0.0;
    if (moves) space.axes.push_back(axis);
  }
  const auto n = static_cast<Eigen::Index>(2 * all.size());
  const auto m = static_cast<Eigen::Index>(space.axes.size());
  space.a = Eigen::MatrixXd::Zero(n, n);
  space.b = Eigen::MatrixXd::Zero(n, m);
  space.c = Eigen::MatrixXd::Zero(m, n);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto q = static_cast<Eigen::Index>(2 * i);
    const double w = all[i].mode.natural_frequency;
    space.a(q, q + 1) = w;
    space.a(q + 1, q) = -w;
    space.a(q + 1, q + 1) = -2.0 * all[i].mode.damping_ratio * w;
    for (Eigen::Index row = 0; row < m; ++row) {
      space.c(row, q) = all[i].out[space.axes[row]];
      space.b(q + 1, row) = all[i].in[space.axes[row]] / w;
    }
  }
  return space;
}

}  // namespace millstudy::dynamics
