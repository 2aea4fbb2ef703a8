// SPDX-License-Identifier: MIT
#include "dynamics/time_domain.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "core/units.h"
#include "core/watch.h"
#include "dynamics/interval_step.h"
#include "dynamics/simulated_edge.h"
#include "dynamics/state_space.h"

namespace millstudy::dynamics {
namespace {

constexpr int kTurnsBefore = 2;
constexpr int kSamples = 24;  // of the position, per turn, for the verdict

void check(const TimeDomain& settings, double spindle_speed) {
  if (!(spindle_speed > 0.0 && std::isfinite(spindle_speed))) {
    throw core::InputError(
        fmt::format("spindle speed = {} rad/s must be > 0 and finite", spindle_speed));
  }
  if (!(settings.feed_per_tooth >= 0.0 && std::isfinite(settings.feed_per_tooth))) {
    throw core::InputError(
        fmt::format("feed per tooth = {} mm must be >= 0", settings.feed_per_tooth));
  }
  if (!(settings.process_damping >= 0.0 && std::isfinite(settings.process_damping))) {
    throw core::InputError(
        fmt::format("process damping = {} N/mm must be >= 0 and finite", settings.process_damping));
  }
  if (settings.steps_per_cycle < 10 || settings.revolutions < 10 || settings.discs < 0) {
    throw core::InputError(
        fmt::format("steps per cycle = {} and revolutions = {} must be >= 10, discs = {} >= 0",
                    settings.steps_per_cycle, settings.revolutions, settings.discs));
  }
}

class Simulation {
 public:
  Simulation(const Machine& machine, const force::CuttingEdges& edges, const force::Arc& arc,
             const force::Coefficients& coefficients, double spindle_speed,
             const TimeDomain& settings)
      : space_(state_space(machine)),
        edge_(edges, settings.discs, kTurnsBefore, settings.tool_leaves_cut),
        variation_(edges.variation()),
        arc_(arc),
        k_{coefficients.Ktc, coefficients.Krc, coefficients.Kac,
           coefficients.Kte, coefficients.Kre, coefficients.Kae},
        leaves_(settings.tool_leaves_cut),
        damping_(settings.process_damping / (spindle_speed * cutter::radius(edges.cutter()))),
        velocity_(space_.velocity()),
        feed_per_angle_(settings.feed_per_tooth * edges.cutter().flutes / core::kTurn) {
    const double cycles = fastest(coefficients, edges) / spindle_speed;  // of vibration in a turn
    // A multiple of the samples; 360 steps a turn at least, for the arc.
    const int least = std::max(360, static_cast<int>(settings.steps_per_cycle * cycles));
    steps_ = kSamples * ((least + kSamples - 1) / kSamples);
    angle_step_ = core::kTurn / steps_;
    step_ = interval_step(space_, Eigen::Matrix2d::Zero(), angle_step_ / spindle_speed, 1);
    state_ = Eigen::VectorXd::Zero(space_.states());
    places_.assign((kTurnsBefore + 1) * steps_ + 2, Eigen::Vector2d::Zero());
  }

  int steps() const { return steps_; }

  Eigen::Vector2d place() const { return in_plane(space_.c); }

  void disturb(double size) {
    for (Eigen::Index i = 0; i < state_.size(); ++i) state_[i] += size * (i % 2 ? -0.7 : 1.0);
  }

  /// Goes on by one step. @return the position at its beginning
  Eigen::Vector2d advance(bool regenerates) {
    const Eigen::Vector2d now = place();
    at(count_) = now;
    Eigen::VectorXd next;
    // The force at the middle of the step depends on its end: two corrections leave 1e-4 of that.
    Eigen::Vector2d middle = count_ > 0 ? Eigen::Vector2d(1.5 * now - 0.5 * at(count_ - 1)) : now;
    const Eigen::Vector2d speed_now =
        damping_ > 0.0 ? in_plane(velocity_) : Eigen::Vector2d::Zero();
    Eigen::Vector2d speed = speed_now;
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::Vector2d f = force(middle, speed, regenerates);
      Eigen::VectorXd moving(space_.moving());
      for (int i = 0; i < space_.moving(); ++i) moving[i] = f[space_.axes[i]];
      next = step_.exponential * state_ + step_.drive[0] * moving;
      std::swap(next, state_);
      middle = 0.5 * (now + place());
      if (damping_ > 0.0) speed = 0.5 * (speed_now + in_plane(velocity_));
      std::swap(next, state_);
    }
    state_ = next;
    ++count_;
    return now;
  }

 private:
  /// What a row of the state space per moving axis makes of the state, along x and y.
  Eigen::Vector2d in_plane(const Eigen::MatrixXd& rows) const {
    const Eigen::VectorXd moving = rows * state_;
    Eigen::Vector2d all = Eigen::Vector2d::Zero();
    for (int i = 0; i < space_.moving(); ++i) all[space_.axes[i]] = moving[i];
    return all;
  }

  /// [rad/s], of the modes stiffened and damped by the cut.
  double fastest(const force::Coefficients& k, const force::CuttingEdges& edges) const {
    const double stiffness = (std::abs(k.Ktc) + std::abs(k.Krc) + std::abs(k.Kac)) *
                             edges.axial_depth() * std::max(1.0, 0.5 * edges.cutter().flutes);
    const double damping = damping_ * edges.axial_depth() * edges.cutter().flutes;
    double largest = 0.0;
    for (Eigen::Index q = 0; q < space_.a.rows(); q += 2) {
      const double w = space_.a(q, q + 1);
      const double added = stiffness * w * space_.b.row(q + 1).cwiseAbs().maxCoeff();
      const double decay = damping * w * space_.b.row(q + 1).cwiseAbs().maxCoeff();
      largest = std::max({largest, std::sqrt(w * w + added), decay});
    }
    return largest;
  }

  Eigen::Vector2d& at(std::int64_t step) {
    const auto size = static_cast<std::int64_t>(places_.size());
    return places_[static_cast<std::size_t>((step % size + size) % size)];
  }

  /// The position so many steps before the middle of this one, by the line between its neighbours.
  Eigen::Vector2d before(double steps) {
    const double place = static_cast<double>(count_) + 0.5 - steps;
    const double whole = std::floor(place);
    const double share = place - whole;
    const auto step = static_cast<std::int64_t>(whole);
    if (step < 0) return Eigen::Vector2d::Zero();
    return (1.0 - share) * at(step) + share * at(step + 1);
  }

  /// (D24), (D26): force on the tool at the middle of the step, for a position and a velocity
  /// there.
  Eigen::Vector2d force(const Eigen::Vector2d& now, const Eigen::Vector2d& speed,
                        bool regenerates) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    const double from = angle_step_ * static_cast<double>(count_ % steps_);
    const double width = arc_.exit_angle - arc_.entry_angle;
    for (const SimulatedEdge::Disc& disc : edge_.discs()) {
      // The part of the step in which the disc is in the arc.
      double past = std::fmod(from + disc.tip - arc_.entry_angle, core::kTurn);
      if (past < 0.0) past += core::kTurn;
      if (past > core::kTurn - angle_step_) past -= core::kTurn;
      const double begin = std::max(past, 0.0), end = std::min(past + angle_step_, width);
      if (end <= begin) continue;
      const double phi = arc_.entry_angle + 0.5 * (begin + end);
      const double share = (end - begin) / angle_step_;
      const double s = std::sin(phi), c = std::cos(phi);
      double chip = 1e300;
      for (const SimulatedEdge::Before& b : disc.before) {
        double reach = feed_per_angle_ * b.angle * s + b.ahead;
        if (regenerates) {
          const Eigen::Vector2d moved = now - before(b.angle / angle_step_);
          reach += moved[0] * s + moved[1] * c;
        }
        chip = std::min(chip, reach * disc.sin_kappa);
      }
      if (leaves_ && chip <= 0.0) continue;
      std::array<double, 3> along;
      for (int q = 0; q < 3; ++q) {
        const double exponent = variation_.size_exponent[q];
        const double size =
            exponent == 0.0
                ? 1.0
                : std::pow(std::max(chip, 0.0) / variation_.reference_chip_thickness, -exponent);
        along[q] = share * (k_[q] * disc.factors[q] * size * chip * disc.width +
                            k_[q + 3] * disc.factors[q + 3] * disc.length);
      }
      const double outward = disc.sin_kappa * (speed[0] * s + speed[1] * c);
      along[1] += share * damping_ * disc.width * outward;
      const double radial = along[1] * disc.sin_kappa + along[2] * disc.cos_kappa;
      sum += Eigen::Vector2d(-along[0] * c - radial * s, along[0] * s - radial * c);
    }
    return sum;
  }

  StateSpace space_;
  SimulatedEdge edge_;
  force::Variation variation_;
  force::Arc arc_;
  std::array<double, 6> k_;
  bool leaves_;
  double damping_;  // [N s/mm2]
  Eigen::MatrixXd velocity_;
  double feed_per_angle_;
  int steps_ = 0;
  double angle_step_ = 0.0;
  IntervalStep step_;
  Eigen::VectorXd state_;
  std::vector<Eigen::Vector2d> places_;  // a ring
  std::int64_t count_ = 0;
};

/// Slope of values over their index.
double slope_of(const std::vector<double>& values, std::size_t first) {
  const auto n = static_cast<double>(values.size() - first);
  double mean = 0.0, sum = 0.0, square = 0.0;
  for (std::size_t i = first; i < values.size(); ++i) mean += values[i] / n;
  for (std::size_t i = first; i < values.size(); ++i) {
    const double x = static_cast<double>(i - first) - 0.5 * (n - 1.0);
    sum += x * (values[i] - mean);
    square += x * x;
  }
  return square > 0.0 ? sum / square : 0.0;
}

}  // namespace

Simulated simulate(const Machine& machine, const cutter::Cutter& cutter,
                   const force::Engagement& engagement, const force::Coefficients& coefficients,
                   double spindle_speed, const TimeDomain& settings,
                   const force::Variation& variation) {
  cutter::check(cutter);
  force::check(cutter, engagement);
  force::check(variation);
  check(settings, spindle_speed);
  if (variation.with_chip() && !variation.with_exponent()) {
    throw core::InputError("orthogonal data that vary with the chip are not simulated");
  }
  const force::CuttingEdges edges(cutter, engagement.axial_depth, variation);
  Simulation simulation(machine, edges, engagement.arc(), coefficients, spindle_speed, settings);

  // (D25): the vibration forced without regeneration dies to itself with the slowest mode.
  double slowest = 1e300;
  const StateSpace space = state_space(machine);
  for (Eigen::Index q = 0; q < space.a.rows(); q += 2) {
    slowest = std::min(slowest, -0.5 * space.a(q + 1, q + 1));
  }
  const double settling = 12.0 * spindle_speed / (core::kTurn * std::max(slowest, 1e-300));
  const int settle = static_cast<int>(std::min(2000.0, kTurnsBefore + 1.0 + settling));
  double largest = 0.0;
  if (settings.feed_per_tooth > 0.0) {
    for (int i = 0; i < settle * simulation.steps(); ++i) {
      if (i % 256 == 0) core::keep_watch();
      largest = std::max(largest, simulation.advance(false).norm());
    }
  }
  const double scale = settings.feed_per_tooth > 0.0 ? settings.feed_per_tooth : 1.0;
  simulation.disturb(1e-4 * scale);

  Simulated result;
  std::vector<Eigen::Vector2d> last(kSamples, Eigen::Vector2d::Zero()), now(kSamples);
  std::vector<double> logs;
  bool dead = false;
  const int every = simulation.steps() / kSamples;
  for (int turn = 0; turn < settings.revolutions; ++turn) {
    core::keep_watch();
    double square = 0.0;
    result.last_turn.clear();
    for (int i = 0; i < simulation.steps(); ++i) {
      const Eigen::Vector2d place = simulation.advance(true);
      if (i == 0) result.once_per_turn.push_back(place);
      result.last_turn.push_back(place);
      if (i % every == 0) now[i / every] = place;
    }
    for (int i = 0; i < kSamples; ++i) square += (now[i] - last[i]).squaredNorm();
    std::swap(now, last);
    result.revolutions = turn + 1;
    if (turn < 1) continue;
    const double distance = std::sqrt(square / kSamples);
    const double floor = 1e-14 * (largest + 1e-290);
    dead = distance <= floor;
    if (dead || !std::isfinite(distance)) break;
    logs.push_back(std::log(distance));
    if (settings.tool_leaves_cut && distance > 0.3 * scale) {
      result.saturated = true;
      break;
    }
    const std::size_t first = logs.size() / 3;
    result.growth_per_turn = slope_of(logs, first);
    const double seen = result.growth_per_turn * static_cast<double>(logs.size() - first);
    if (logs.size() >= 12 && std::abs(seen) > settings.decades * std::log(10.0)) break;
  }
  // A bounded vibration that does not die: the tool keeps leaving the cut.
  const double seen = result.growth_per_turn * static_cast<double>(logs.size());
  if (settings.tool_leaves_cut && !dead && seen > -std::log(2.0)) result.saturated = true;
  result.stable = !result.saturated && result.growth_per_turn < 0.0;
  return result;
}

}  // namespace millstudy::dynamics
