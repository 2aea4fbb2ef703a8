// SPDX-License-Identifier: MIT
#include "dynamics/semi_discretization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "core/watch.h"
#include "dynamics/interval_step.h"

namespace millstudy::dynamics {
namespace {

constexpr int kMostIntervals = 1'000'000;

/// Coefficients over sigma of the Lagrange polynomial that is 1 at node l of 0 .. order and 0 at
/// the others, at the place sigma + shift.
std::array<double, 3> lagrange(int order, int l, double shift) {
  std::array<double, 3> p = {1.0, 0.0, 0.0};
  for (int k = 0; k <= order; ++k) {
    if (k == l) continue;
    const double scale = 1.0 / (l - k), constant = (shift - k) * scale;
    p = {p[0] * constant, p[1] * constant + p[0] * scale, p[2] * constant + p[1] * scale};
  }
  return p;
}

}  // namespace

void SemiDiscretizedMap::add_taps(double delay, int order) {
  // (D11). Interval i is 0 <= sigma <= 1 at the times i + sigma; the delayed place is that - delay.
  const auto add = [&](int back, std::array<double, 3> weight) {
    taps_.push_back({back, {weight[0], weight[1], weight[2]}});
    history_ = std::max(history_, back);
  };
  first_tap_.push_back(static_cast<int>(taps_.size()));
  // The first node, so many intervals back: the middle of the interval is between it and the next.
  const int r = std::max(1, static_cast<int>(std::ceil(delay - 0.5 - 1e-9)));
  if (order == 0) {
    const double middle = 0.5 - delay + r;
    add(r, {1.0 - middle, 0.0, 0.0});
    add(r - 1, {middle, 0.0, 0.0});
    return;
  }
  const int first = order == 2 && r < 2 ? r + 1 : r;
  for (int l = 0; l <= order; ++l) add(first - l, lagrange(order, l, first - delay));
}

SemiDiscretizedMap::SemiDiscretizedMap(const DelaySystem& system,
                                       const SemiDiscretization& settings)
    : states_(system.machine.states()),
      moving_(system.machine.moving()),
      intervals_(settings.intervals),
      terms_(settings.order + 1),
      c_(system.machine.c) {
  if (intervals_ < 1 || intervals_ > kMostIntervals) {
    throw core::InputError(
        fmt::format("intervals = {} must be between 1 and {}", intervals_, kMostIntervals));
  }
  if (settings.order < 0 || settings.order > 2) {
    throw core::InputError(fmt::format("order = {} must be 0, 1 or 2", settings.order));
  }
  const double step = system.period / intervals_;
  if (system.shortest_delay < step * (1.0 - 1e-9)) {
    throw core::InputError(fmt::format(
        "intervals = {} are too few: one must not be longer than the shortest delay", intervals_));
  }
  core::keep_watch();
  const AveragedGains gains = system.averages(intervals_);
  for (const double delay : gains.delays) add_taps(delay / step, settings.order);
  first_tap_.push_back(static_cast<int>(taps_.size()));

  const auto delays = static_cast<int>(gains.delays.size());
  stride_ = states_ * states_ + terms_ * states_ * moving_ + delays * moving_ * moving_;
  steps_.resize(static_cast<std::size_t>(stride_) * intervals_);
  const IntervalStep free = interval_step(system.machine, Eigen::Matrix2d::Zero(), step, terms_);
  IntervalStep cutting;
  const bool damped = !gains.damping.empty();
  const bool one_mode = !damped && OneModeStep::serves(system.machine, terms_);
  const OneModeStep closed(system.machine, step);
  for (int i = 0; i < intervals_; ++i) {
    double* out = steps_.data() + static_cast<std::size_t>(stride_) * i;
    if (one_mode && closed.make(gains.direct[i](0, 0), out)) {
      for (int d = 0; d < delays; ++d) {
        out[6 + d] = gains.delayed[static_cast<std::size_t>(i) * delays + d](0, 0);
      }
      continue;
    }
    const auto append = [&](const auto& matrix) {  // column by column
      for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        for (Eigen::Index row = 0; row < matrix.rows(); ++row) *out++ = matrix(row, column);
      }
    };
    const bool is_free = gains.direct[i].isZero(0.0) && (!damped || gains.damping[i].isZero(0.0));
    if (!is_free) {
      const Eigen::Matrix2d damping = damped ? gains.damping[i] : Eigen::Matrix2d::Zero();
      cutting = interval_step(system.machine, gains.direct[i], step, terms_, damping);
    }
    const IntervalStep& now = is_free ? free : cutting;
    append(now.exponential);
    for (int k = 0; k < terms_; ++k) append(now.drive[k]);
    for (int d = 0; d < delays; ++d) {
      append(
          gains.delayed[static_cast<std::size_t>(i) * delays + d].topLeftCorner(moving_, moving_));
    }
  }
}

void SemiDiscretizedMap::run_one_mode(double* u, double* state) const {
  double q = state[0], v = state[1];
  const double c = c_(0, 0);
  const auto delays = static_cast<int>(first_tap_.size()) - 1;
  const double* data = steps_.data();
  double* now = u + history_;
  for (int i = 0; i < intervals_; ++i, data += stride_, ++now) {
    *now = c * q;
    double force = 0.0;
    for (int d = 0; d < delays; ++d) {
      double place = 0.0;
      for (int tap = first_tap_[d]; tap < first_tap_[d + 1]; ++tap) {
        place += taps_[tap].weight[0] * now[-taps_[tap].back];
      }
      force += data[6 + d] * place;
    }
    const double next = data[0] * q + (data[2] * v + data[4] * force);
    v = data[3] * v + (data[1] * q + data[5] * force);
    q = next;
  }
  state[0] = q;
  state[1] = v;
}

template <int States, int Moving, int Terms>
void SemiDiscretizedMap::run_sized(double* u, double* state) const {
  using Matrix = Eigen::Map<const Eigen::Matrix<double, States, States>>;
  using Drive = Eigen::Map<const Eigen::Matrix<double, States, Moving>>;
  using Gain = Eigen::Map<const Eigen::Matrix<double, Moving, Moving>>;
  const int n = states_, m = moving_;
  const auto delays = static_cast<int>(first_tap_.size()) - 1;
  Eigen::Matrix<double, States, 1> s = Eigen::Map<Eigen::Matrix<double, States, 1>>(state, n);
  Eigen::Matrix<double, States, 1> next(n);
  const Eigen::Matrix<double, Moving, States> c = c_;
  std::array<Eigen::Matrix<double, Moving, 1>, 3> force;
  const int terms = Terms == Eigen::Dynamic ? terms_ : Terms;
  for (int i = 0; i < intervals_; ++i) {
    const double* data = steps_.data() + static_cast<std::size_t>(stride_) * i;
    double* now = u + static_cast<std::size_t>(m) * (history_ + i);
    Eigen::Map<Eigen::Matrix<double, Moving, 1>>(now, m).noalias() = c.lazyProduct(s);
    const double* gains = data + n * n + terms * n * m;
    for (int k = 0; k < terms; ++k) force[k].setZero(m);
    for (int d = 0; d < delays; ++d) {
      const Gain gain(gains + d * m * m, m, m);
      for (int k = 0; k < terms; ++k) {
        Eigen::Matrix<double, Moving, 1> place = Eigen::Matrix<double, Moving, 1>::Zero(m);
        for (int tap = first_tap_[d]; tap < first_tap_[d + 1]; ++tap) {
          place += taps_[tap].weight[k] *
                   Eigen::Map<const Eigen::Matrix<double, Moving, 1>>(now - m * taps_[tap].back, m);
        }
        force[k].noalias() += gain.lazyProduct(place);
      }
    }
    next.noalias() = Matrix(data, n, n).lazyProduct(s);
    for (int k = 0; k < terms; ++k) {
      next.noalias() += Drive(data + n * n + k * n * m, n, m).lazyProduct(force[k]);
    }
    s = next;
  }
  Eigen::Map<Eigen::Matrix<double, States, 1>>(state, n) = s;
}

void SemiDiscretizedMap::run(const double* in, std::vector<double>& positions,
                             double* state) const {
  constexpr int any = Eigen::Dynamic;
  positions.resize(static_cast<std::size_t>(moving_) * (history_ + intervals_));
  std::copy(in, in + moving_ * history_, positions.begin());
  std::copy(in + moving_ * history_, in + size(), state);
  double* u = positions.data();
  if (states_ == 2 && moving_ == 1 && terms_ == 1) return run_one_mode(u, state);
  if (states_ == 4 && moving_ == 2 && terms_ == 1) return run_sized<4, 2, 1>(u, state);
  if (states_ == 8 && moving_ == 2 && terms_ == 1) return run_sized<8, 2, 1>(u, state);
  if (moving_ == 1) return run_sized<any, 1, any>(u, state);
  return run_sized<any, 2, any>(u, state);
}

void SemiDiscretizedMap::apply(const double* in, double* out) const {
  thread_local std::vector<double> positions;
  run(in, positions, out + moving_ * history_);
  std::copy(positions.end() - moving_ * history_, positions.end(), out);
}

LinearMap SemiDiscretizedMap::map() const {
  return {size(), [this](const double* in, double* out) { apply(in, out); }};
}

Eigen::MatrixXcd SemiDiscretizedMap::motion(const Eigen::VectorXcd& vector) const {
  Eigen::MatrixXcd all(moving_, intervals_);
  std::vector<double> positions;
  Eigen::VectorXd state(states_);
  const auto add = [&](const Eigen::VectorXd& part, std::complex<double> unit) {
    run(part.data(), positions, state.data());
    all += unit * Eigen::Map<const Eigen::MatrixXd>(positions.data() + moving_ * history_, moving_,
                                                    intervals_);
  };
  all.setZero();
  add(vector.real(), 1.0);
  add(vector.imag(), {0.0, 1.0});
  return all;
}

}  // namespace millstudy::dynamics
