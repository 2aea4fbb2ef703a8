// SPDX-License-Identifier: MIT
#include "dynamics/collocation.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "core/units.h"
#include "core/watch.h"
#include "dynamics/gauss_collocation.h"

namespace millstudy::dynamics {
namespace {

/// (D15): positions at the nodes and the state at the end, from the state at the start and the
/// forces at the nodes, without cutting. The same for all elements of one length.
struct FreeElement {
  Eigen::MatrixXd nodes_of_state;  // m N x n
  Eigen::MatrixXd nodes_of_force;  // m N x m N
  Eigen::MatrixXd speed_of_state;  // m N x n: velocities at the nodes
  Eigen::MatrixXd speed_of_force;  // m N x m N
  Eigen::MatrixXd end_of_state;    // n x n
  Eigen::MatrixXd end_of_force;    // n x m N
};

FreeElement free_element(const StateSpace& machine, const GaussCollocation& gauss, double h) {
  const Eigen::Index n = machine.states(), m = machine.moving(), count = gauss.nodes.size();
  FreeElement free;
  free.nodes_of_state = Eigen::MatrixXd::Zero(m * count, n);
  free.nodes_of_force = Eigen::MatrixXd::Zero(m * count, m * count);
  free.speed_of_state = Eigen::MatrixXd::Zero(m * count, n);
  free.speed_of_force = Eigen::MatrixXd::Zero(m * count, m * count);
  free.end_of_state = Eigen::MatrixXd::Zero(n, n);
  free.end_of_force = Eigen::MatrixXd::Zero(n, m * count);
  // Modes do not see one another: each is a system of 2 N unknowns.
  for (Eigen::Index q = 0; q < n; q += 2) {
    const Eigen::Matrix2d a = machine.a.block<2, 2>(q, q);
    Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(2 * count, 2 * count);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(2 * count, 2 + m * count);
    for (Eigen::Index i = 0; i < count; ++i) {
      right.block<2, 2>(2 * i, 0).setIdentity();
      for (Eigen::Index j = 0; j < count; ++j) {
        const double weight = h * gauss.integral(i, j);
        whole.block<2, 2>(2 * i, 2 * j) -= weight * a;
        right.block(2 * i, 2 + m * j, 2, m) = weight * machine.b.block(q, 0, 2, m);
      }
    }
    const Eigen::MatrixXd x = whole.partialPivLu().solve(right);
    free.end_of_state.block<2, 2>(q, q).setIdentity();
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::MatrixXd u = machine.c.block(0, q, m, 2) * x.middleRows<2>(2 * i);
      free.nodes_of_state.block(m * i, q, m, 2) += u.leftCols<2>();
      free.nodes_of_force.middleRows(m * i, m) += u.rightCols(m * count);
      const Eigen::MatrixXd speed = a(0, 1) * machine.c.block(0, q, m, 1) * x.row(2 * i + 1);
      free.speed_of_state.block(m * i, q, m, 2) += speed.leftCols<2>();
      free.speed_of_force.middleRows(m * i, m) += speed.rightCols(m * count);
      const double weight = h * gauss.weights[i];
      const Eigen::MatrixXd slope = weight * (a * x.middleRows<2>(2 * i));
      free.end_of_state.block<2, 2>(q, q) += slope.leftCols<2>();
      free.end_of_force.middleRows<2>(q) += slope.rightCols(m * count);
      free.end_of_force.block(q, m * i, 2, m) += weight * machine.b.block(q, 0, 2, m);
    }
  }
  return free;
}

}  // namespace

CollocationMap::CollocationMap(const DelaySystem& system, const Collocation& settings)
    : states_(system.machine.states()),
      moving_(system.machine.moving()),
      nodes_(settings.nodes),
      axes_(system.machine.axes),
      period_(system.period),
      c_(system.machine.c) {
  if (nodes_ < 2 || nodes_ > 16) {
    throw core::InputError(fmt::format("nodes = {} must be between 2 and 16", nodes_));
  }
  if (!(settings.longest_turn > 0.0)) {
    throw core::InputError(fmt::format("longest turn = {} rad must be > 0", settings.longest_turn));
  }
  const double fastest = system.machine.a.cwiseAbs().maxCoeff();
  const double longest = std::min(system.shortest_delay, settings.longest_turn / fastest);
  for (std::size_t i = 0; i < system.breaks.size(); ++i) {
    const bool last = i + 1 == system.breaks.size();
    add_stretch(system, system.breaks[i], last ? period_ : system.breaks[i + 1], longest);
  }
  const GaussCollocation& gauss = gauss_collocation(nodes_);
  for (int e = 0; e < elements(); ++e) {
    for (int i = 0; i < nodes_; ++i) {
      const double t = elements_[e].start + gauss.nodes[i] * elements_[e].length;
      for (const DelayedGain& delayed : system.at(t).delayed) add_taps(e, i, t, delayed);
    }
  }
}

void CollocationMap::add_stretch(const DelaySystem& system, double start, double end,
                                 double longest) {
  const GaussCollocation& gauss = gauss_collocation(nodes_);
  const Eigen::Index n = states_, m = moving_, mn = m * nodes_;
  const int parts = 1 + static_cast<int>((end - start) / longest * (1.0 - 1e-9));
  const double h = (end - start) / parts;
  const FreeElement free = free_element(system.machine, gauss, h);
  Eigen::MatrixXd gains(mn, mn), damping(mn, mn);
  for (int part = 0; part < parts; ++part) {
    core::keep_watch();
    Element element{start + part * h, h, {}, Eigen::MatrixXd(mn + n, n + mn)};
    gains.setZero();
    damping.setZero();
    for (int i = 0; i < nodes_; ++i) {
      const Gains now = system.at(element.start + gauss.nodes[i] * h);
      gains.block(m * i, m * i, m, m) = now.direct.topLeftCorner(m, m);
      damping.block(m * i, m * i, m, m) = now.damping.topLeftCorner(m, m);
    }
    // The force at the nodes is f - W u - B u', u and u' of itself: (1 + W U + B V) force = f - W
    // (u of the state) - B (u' of the state).
    const bool damped = !damping.isZero(0.0);
    Eigen::MatrixXd& step = element.step;
    if (gains.isZero(0.0) && !damped) {
      step << free.nodes_of_state, free.nodes_of_force, free.end_of_state, free.end_of_force;
    } else {
      Eigen::MatrixXd whole = gains * free.nodes_of_force;
      whole.diagonal().array() += 1.0;
      Eigen::MatrixXd right(mn, n + mn);
      right << -gains * free.nodes_of_state, Eigen::MatrixXd::Identity(mn, mn);
      if (damped) {
        whole += damping * free.speed_of_force;
        right.leftCols(n) -= damping * free.speed_of_state;
      }
      const Eigen::MatrixXd force = whole.partialPivLu().solve(right);
      step.topRows(mn).noalias() = free.nodes_of_force * force;
      step.topLeftCorner(mn, n) += free.nodes_of_state;
      step.bottomRows(n).noalias() = free.end_of_force * force;
      step.bottomLeftCorner(n, n) += free.end_of_state;
    }
    elements_.push_back(std::move(element));
  }
}

void CollocationMap::add_taps(int element, int node, double time, const DelayedGain& delayed) {
  const double before = time - delayed.delay;
  double turns = std::floor(before / period_);
  double t = before - turns * period_;
  // A time that rounding has put at the end of a period belongs to the next one.
  if (t >= period_ * (1.0 - 1e-14)) t = 0.0, turns += 1.0;
  const auto next = std::upper_bound(elements_.begin(), elements_.end(), t,
                                     [](double at, const Element& e) { return at < e.start; });
  const auto which = static_cast<int>(next - elements_.begin()) - 1;
  const Element& there = elements_[which];
  const int far = static_cast<int>(turns) * elements() + which - element;  // elements, < 0
  const int first = far * (nodes_ + 1);
  history_ = std::max(history_, -(far + element) * (nodes_ + 1));
  const Eigen::VectorXd weights =
      gauss_collocation(nodes_).interpolation((t - there.start) / there.length);
  for (int k = 0; k <= nodes_; ++k) {
    if (weights[k] == 0.0) continue;
    elements_[element].taps.push_back({node, first + k, weights[k] * delayed.gain});
  }
}

void CollocationMap::run(const double* in, std::vector<double>& positions, double* state,
                         const double* force_at_nodes) const {
  core::keep_watch();
  const Eigen::Index n = states_, m = moving_;
  const std::size_t per_element = m * (nodes_ + 1);
  positions.resize(m * history_ + per_element * elements_.size());
  std::copy(in, in + m * history_, positions.begin());
  Eigen::VectorXd given(n + m * nodes_), found(m * nodes_ + n);
  given.head(n) = Eigen::Map<const Eigen::VectorXd>(in + m * history_, n);
  double* first = positions.data() + m * history_;
  for (const Element& element : elements_) {
    Eigen::Map<Eigen::VectorXd>(first, m).noalias() = c_ * given.head(n);
    double* force = given.data() + n;
    if (force_at_nodes) {
      std::copy(force_at_nodes, force_at_nodes + m * nodes_, force);
      force_at_nodes += m * nodes_;
    } else {
      given.tail(m * nodes_).setZero();
    }
    for (const Tap& tap : element.taps) {
      const double* u = first + m * tap.place;
      double* f = force + m * tap.node;
      if (m == 1) {
        f[0] += tap.gain(0, 0) * u[0];
      } else {
        f[0] += tap.gain(0, 0) * u[0] + tap.gain(0, 1) * u[1];
        f[1] += tap.gain(1, 0) * u[0] + tap.gain(1, 1) * u[1];
      }
    }
    found.noalias() = element.step * given;
    std::copy(found.data(), found.data() + m * nodes_, first + m);
    given.head(n) = found.tail(n);
    first += per_element;
  }
  std::copy(given.data(), given.data() + n, state);
}

void CollocationMap::apply(const double* in, double* out) const {
  thread_local std::vector<double> positions;
  run(in, positions, out + moving_ * history_);
  std::copy(positions.end() - moving_ * history_, positions.end(), out);
}

std::vector<double> CollocationMap::force_at_nodes(
    const std::function<Eigen::Vector2d(double t)>& force) const {
  const GaussCollocation& gauss = gauss_collocation(nodes_);
  std::vector<double> all;
  for (const Element& element : elements_) {
    for (int i = 0; i < nodes_; ++i) {
      const Eigen::Vector2d f = force(element.start + gauss.nodes[i] * element.length);
      for (const int axis : axes_) all.push_back(f[axis]);
    }
  }
  return all;
}

void CollocationMap::apply(const double* in, double* out, const std::vector<double>& force) const {
  thread_local std::vector<double> positions;
  run(in, positions, out + moving_ * history_, force.data());
  std::copy(positions.end() - moving_ * history_, positions.end(), out);
}

PeriodicMotion CollocationMap::motion(const double* in, const std::vector<double>& force) const {
  std::vector<double> positions;
  Eigen::VectorXd state(states_);
  run(in, positions, state.data(), force.data());
  std::vector<double> starts;
  for (const Element& element : elements_) starts.push_back(element.start);
  positions.erase(positions.begin(), positions.begin() + moving_ * history_);
  return {period_, std::move(starts), nodes_, axes_, std::move(positions)};
}

LinearMap CollocationMap::map() const {
  return {size(), [this](const double* in, double* out) { apply(in, out); }};
}

Eigen::MatrixXcd CollocationMap::spectrum(const Eigen::VectorXcd& vector,
                                          std::complex<double> multiplier, int harmonics) const {
  const GaussCollocation& gauss = gauss_collocation(nodes_);
  Eigen::MatrixXcd all = Eigen::MatrixXcd::Zero(moving_, 2 * harmonics + 1);
  std::vector<double> real, imaginary;
  Eigen::VectorXd state(states_);
  run(Eigen::VectorXd(vector.real()).data(), real, state.data());
  run(Eigen::VectorXd(vector.imag()).data(), imaginary, state.data());
  const std::complex<double> exponent = std::log(multiplier) / period_;
  std::size_t at = static_cast<std::size_t>(moving_) * history_;
  for (const Element& element : elements_) {
    at += moving_;
    for (int i = 0; i < nodes_; ++i, at += moving_) {
      const double t = element.start + gauss.nodes[i] * element.length;
      const double weight = gauss.weights[i] * element.length / period_;
      const std::complex<double> turn = std::polar(1.0, -core::kTurn * t / period_);
      const double start = core::kTurn * harmonics * t / period_;
      std::complex<double> factor = weight * std::exp(-exponent * t) * std::polar(1.0, start);
      for (int k = 0; k <= 2 * harmonics; ++k, factor *= turn) {
        for (int axis = 0; axis < moving_; ++axis) {
          all(axis, k) += factor * std::complex<double>(real[at + axis], imaginary[at + axis]);
        }
      }
    }
  }
  return all;
}

}  // namespace millstudy::dynamics
