// SPDX-License-Identifier: MIT
#include "dynamics/interval_step.h"

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

}  // namespace

bool OneModeStep::serves(const StateSpace& machine, int terms) {
  return machine.states() == 2 && machine.moving() == 1 && terms == 1;
}

OneModeStep::OneModeStep(const StateSpace& machine, double duration)
    : w_(machine.a(0, 1)),
      damping_(machine.a(1, 1)),
      b_(machine.b(1, 0)),
      stiffening_(machine.b(1, 0) * machine.c(0, 0)),
      duration_(duration),
      decay_(std::exp(0.5 * damping_ * duration)),
      decay_less_one_(std::expm1(0.5 * damping_ * duration)) {}

bool OneModeStep::make(double gain, double* out) const {
  // a - b W c = [0 w; -w - W.. d]: exp = e^(s h) (C + S (a - s)), s = d/2, its parts less the unit
  // matrix so that short intervals lose nothing.
  const double below = -w_ - stiffening_ * gain, s = 0.5 * damping_;
  const double determinant = -w_ * below, square = s * s - determinant;
  if (std::abs(determinant) < 1e-3 * w_ * w_) return false;
  const double root = std::sqrt(std::abs(square)), half = 0.5 * root * duration_;
  double c_less_one, sine;
  if (square < 0.0) {
    const double sn = std::sin(half), cs = std::cos(half);
    c_less_one = -2.0 * sn * sn;
    sine = 2.0 * sn * cs / root;
  } else {
    const double sn = std::sinh(half), cs = std::cosh(half);
    c_less_one = 2.0 * sn * sn;
    sine = root > 0.0 ? 2.0 * sn * cs / root : duration_;
  }
  const double c = 1.0 + c_less_one;
  const double e00 = decay_less_one_ * (c - s * sine) + c_less_one - s * sine;
  const double e11 = decay_less_one_ * (c + s * sine) + c_less_one + s * sine;
  const double e01 = decay_ * sine * w_;
  out[0] = 1.0 + e00;
  out[1] = decay_ * sine * below;
  out[2] = e01;
  out[3] = 1.0 + e11;
  out[4] = (damping_ * e01 - w_ * e11) * b_ / determinant;
  out[5] = e01 * b_ / w_;
  return true;
}

IntervalStep interval_step(const StateSpace& machine, const Eigen::Matrix2d& gain, double duration,
                           int terms, const Eigen::Matrix2d& damping) {
  const Eigen::Index n = machine.states(), m = machine.moving();
  const bool damped = !damping.isZero(0.0);
  if (!damped && OneModeStep::serves(machine, terms)) {
    std::array<double, 6> e;
    if (OneModeStep(machine, duration).make(gain(0, 0), e.data())) {
      IntervalStep step;
      step.exponential.resize(2, 2);
      step.exponential << e[0], e[2], e[1], e[3];
      step.drive[0].resize(2, 1);
      step.drive[0] << e[4], e[5];
      return step;
    }
  }
  // The force and its derivatives over t/h are states too: g_k' = g_(k+1) / h.
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + terms * m, n + terms * m);
  whole.topLeftCorner(n, n) =
      duration * (machine.a - machine.b * gain.topLeftCorner(m, m) * machine.c);
  if (damped) {
    whole.topLeftCorner(n, n) -=
        duration * (machine.b * damping.topLeftCorner(m, m) * machine.velocity());
  }
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
