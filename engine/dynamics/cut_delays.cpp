// SPDX-License-Identifier: MIT
// A cut as a system with delays (D8): which delays it has, its gains at a time and on average.
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "core/error.h"
#include "dynamics/regenerative_cut.h"

namespace millstudy::dynamics {
namespace {

/// A part of an edge with one delay.
struct Slice {
  int flute;
  double bottom;
  double top;
  int delay;  // which
};

struct Sliced {
  std::vector<double> delays;  // [s]
  std::vector<Slice> slices;
};

/// Delays that differ by roundings are one.
int delay_index(std::vector<double>& delays, double delay) {
  for (std::size_t k = 0; k < delays.size(); ++k) {
    if (std::abs(delays[k] - delay) < 1e-12 * delay) return static_cast<int>(k);
  }
  delays.push_back(delay);
  return static_cast<int>(delays.size()) - 1;
}

/// What the gains are computed from; shared by both functions of the system.
struct Source {
  RegenerativeCut cut;
  double speed;           // [rad/s]
  std::vector<int> axes;  // of the machine
  std::optional<RegenerativeCut> damping;

  double period() const { return cut.period_angle() / speed; }
  double tip_angle(int flute, double t) const {
    return cut.edges().flutes()[flute].position + speed * t;
  }
  int flutes() const { return cut.edges().cutter().flutes; }

  /// Rows and columns of the axes that move.
  Eigen::Matrix2d moving(const Eigen::Matrix2d& a) const {
    if (axes.size() == 2) return a;
    Eigen::Matrix2d one = Eigen::Matrix2d::Zero();
    one(0, 0) = a(axes[0], axes[0]);
    return one;
  }

  Sliced sliced(double longest_step) const {
    Sliced all;
    const cutter::Envelope& envelope = cut.edges().envelope();
    const double depth = cut.edges().axial_depth();
    const double lag = envelope.lag(depth);
    for (int j = 0; j < flutes(); ++j) {
      const double change = std::abs(cut.pitch(j, lag) - cut.pitch(j, 0.0)) / speed;
      const int n = 1 + static_cast<int>(change / longest_step);
      for (int i = 0; i < n; ++i) {
        const auto height = [&](int k) {
          return k == 0 ? 0.0 : k == n ? depth : envelope.height_at_lag(lag * k / n);
        };
        const double delay = cut.pitch(j, lag * (i + 0.5) / n) / speed;
        all.slices.push_back({j, height(i), height(i + 1), delay_index(all.delays, delay)});
      }
    }
    return all;
  }
};

Gains gains_at(const Source& source, double t) {
  Gains gains;
  std::vector<double> delays;
  for (int j = 0; j < source.flutes(); ++j) {
    const double tip = source.tip_angle(j, t);
    if (source.damping) gains.damping += source.moving(source.damping->stiffness(j, tip));
    const auto add = [&](double delay, const Eigen::Matrix2d& a) {
      gains.direct += a;
      const int k = delay_index(delays, delay);
      if (k == static_cast<int>(gains.delayed.size()))
        gains.delayed.push_back({delay, a});
      else
        gains.delayed[k].gain += a;
    };
    if (source.cut.edges().variable_helix()) {
      source.cut.for_each_node(j, tip, [&](double lag, const Eigen::Matrix2d& a) {
        add(source.cut.pitch(j, lag) / source.speed, source.moving(a));
      });
    } else {
      const Eigen::Matrix2d a = source.moving(source.cut.stiffness(j, tip));
      if (!a.isZero(0.0)) add(source.cut.pitch(j, 0.0) / source.speed, a);
    }
  }
  return gains;
}

AveragedGains averages(const Source& source, int intervals) {
  const double step = source.period() / intervals;
  // Half an interval of delay in a slice is an error far below that of the interval itself.
  const Sliced sliced = source.sliced(0.5 * step);
  const std::size_t count = sliced.delays.size();
  AveragedGains all;
  all.delays = sliced.delays;
  all.direct.assign(intervals, Eigen::Matrix2d::Zero());
  all.delayed.assign(intervals * count, Eigen::Matrix2d::Zero());
  const double per_angle = 1.0 / (source.speed * step);
  for (const Slice& slice : sliced.slices) {
    const std::vector<Eigen::Matrix2d> swept =
        source.cut.swept(slice.flute, source.tip_angle(slice.flute, 0.0), source.speed * step,
                         intervals + 1, slice.bottom, slice.top);
    for (int i = 0; i < intervals; ++i) {
      const Eigen::Matrix2d a = per_angle * source.moving(swept[i + 1] - swept[i]);
      all.direct[i] += a;
      all.delayed[i * count + slice.delay] += a;
    }
  }
  if (!source.damping) return all;
  all.damping.assign(intervals, Eigen::Matrix2d::Zero());
  for (int j = 0; j < source.flutes(); ++j) {
    const std::vector<Eigen::Matrix2d> swept =
        source.damping->swept(j, source.tip_angle(j, 0.0), source.speed * step, intervals + 1, 0.0,
                              source.cut.edges().axial_depth());
    for (int i = 0; i < intervals; ++i) {
      all.damping[i] += per_angle * source.moving(swept[i + 1] - swept[i]);
    }
  }
  return all;
}

/// Times at which an end of an edge or a corner of the envelope enters or leaves, and 0.
std::vector<double> breaks(const Source& source) {
  const force::CuttingEdges& edges = source.cut.edges();
  const double period = source.cut.period_angle();
  std::vector<double> lags = {0.0};
  for (const force::EdgePiece& piece : edges.pieces())
    lags.push_back(edges.envelope().lag(piece.top));
  std::vector<double> all;
  for (const cutter::Flute& flute : edges.flutes()) {
    for (const double lag : lags) {
      for (const double limit : {source.cut.arc().entry_angle, source.cut.arc().exit_angle}) {
        const double angle = limit - flute.position + flute.helix_tangent * lag;
        all.push_back((angle - period * std::floor(angle / period)) / source.speed);
      }
    }
  }
  std::sort(all.begin(), all.end());
  const double gap = 1e-9 * source.period();
  std::vector<double> distinct = {0.0};
  for (const double t : all) {
    if (t - distinct.back() > gap && t < source.period() - gap) distinct.push_back(t);
  }
  return distinct;
}

}  // namespace

DelaySystem delay_system(const Machine& machine, const RegenerativeCut& cut, double spindle_speed,
                         double process_damping) {
  if (!(spindle_speed > 0.0 && std::isfinite(spindle_speed))) {
    throw core::InputError(
        fmt::format("spindle speed = {} rad/s must be > 0 and finite", spindle_speed));
  }
  if (!(process_damping >= 0.0 && std::isfinite(process_damping))) {
    throw core::InputError(
        fmt::format("process damping = {} N/mm must be >= 0 and finite", process_damping));
  }
  DelaySystem system;
  system.machine = state_space(machine);
  std::optional<RegenerativeCut> damping;
  if (process_damping > 0.0) {
    const double cutting_speed = spindle_speed * cutter::radius(cut.edges().cutter());
    damping = cut.process_damping(process_damping / cutting_speed);
  }
  const auto source =
      std::make_shared<const Source>(Source{cut, spindle_speed, system.machine.axes, damping});
  system.period = source->period();
  const double lag = cut.edges().envelope().lag(cut.edges().axial_depth());
  std::vector<double> delays;
  for (int j = 0; j < cut.edges().cutter().flutes; ++j) {
    delays.push_back(cut.pitch(j, 0.0) / spindle_speed);
    delays.push_back(cut.pitch(j, lag) / spindle_speed);
  }
  system.shortest_delay = *std::min_element(delays.begin(), delays.end());
  system.longest_delay = *std::max_element(delays.begin(), delays.end());
  system.breaks = breaks(*source);
  system.at = [source](double t) { return gains_at(*source, t); };
  system.averages = [source](int intervals) { return averages(*source, intervals); };
  return system;
}

}  // namespace millstudy::dynamics
