// SPDX-License-Identifier: MIT
#include "dynamics/interval_step.h"

#include <Eigen/LU>
#include <cmath>

namespace millstudy::dynamics {
namespace {

/// exp(a) by Taylor's series of the matrix halved until its norm is below a half.
Eigen::MatrixXd exponential(const Eigen::MatrixXd& a) {
  const Eigen::Index n = a.rows();
  const double norm = a.cwiseAbs().colwise().sum().maxCoeff();
  int halvings = 0;
  for (double size = norm; size > 0.5; size *= 0.5) ++halvings;
  const Eigen::MatrixXd scaled = std::ldexp(1.0, -halvings) * a;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(n, n) + scaled;
  Eigen::MatrixXd term = scaled, next(n, n);
  double size = std::ldexp(norm, -halvings);
  const double once = size;
  for (int k = 2; k < 20 && size > 1e-18; ++k) {
    next.noalias() = term.lazyProduct(scaled);
    term = next / k;
    size *= once / k;
    sum += term;
  }
  for (int i = 0; i < halvings; ++i) {
    next.noalias() = sum.lazyProduct(sum);
    sum.swap(next);
  }
  return sum;
}

/// One mode under a constant force. exp(a h) = e^(s h) (C + S (a - s)), s half the trace.
IntervalStep one_mode(const Eigen::Matrix2d& a, const Eigen::Vector2d& b, double h) {
  const double s = 0.5 * a.trace();
  const double square = s * s - a.determinant();
  const double root = std::sqrt(std::abs(square));
  const double x = root * h;
  const double c = square < 0.0 ? std::cos(x) : std::cosh(x);
  const double sine = x == 0.0 ? h : (square < 0.0 ? std::sin(x) : std::sinh(x)) / root;
  Eigen::Matrix2d e = sine * a;
  e.diagonal().array() += c - s * sine;
  e *= std::exp(s * h);
  IntervalStep step;
  step.exponential = e;
  e.diagonal().array() -= 1.0;
  step.drive[0] = a.inverse() * (e * b);
  return step;
}

}  // namespace

IntervalStep interval_step(const StateSpace& machine, const Eigen::Matrix2d& gain, double duration,
                           int terms) {
  const Eigen::Index n = machine.states(), m = machine.moving();
  if (n == 2 && m == 1 && terms == 1) {
    Eigen::Matrix2d a = machine.a;
    a.noalias() -= machine.b * gain(0, 0) * machine.c;
    // Near a = singular and for short intervals the inverse loses digits: the series then is short.
    if (std::abs(a.determinant()) * duration * duration > 1e-3) {
      return one_mode(a, machine.b, duration);
    }
  }
  // The force and its derivatives over t/h are states too: g_k' = g_(k+1) / h.
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + terms * m, n + terms * m);
  whole.topLeftCorner(n, n) =
      duration * (machine.a - machine.b * gain.topLeftCorner(m, m) * machine.c);
  whole.block(0, n, n, m) = duration * machine.b;
  for (int k = 0; k + 1 < terms; ++k) {
    whole.block(n + k * m, n + (k + 1) * m, m, m).setIdentity();
  }
  const Eigen::MatrixXd e = exponential(whole);
  IntervalStep step;
  step.exponential = e.topLeftCorner(n, n);
  double factorial = 1.0;
  for (int k = 0; k < terms; ++k) {
    if (k > 0) factorial *= k;
    step.drive[k] = factorial * e.block(0, n + k * m, n, m);
  }
  return step;
}

}  // namespace millstudy::dynamics
