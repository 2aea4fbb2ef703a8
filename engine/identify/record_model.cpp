// SPDX-License-Identifier: MIT
#include "identify/record_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/units.h"
#include "identify/low_pass.h"
#include "identify/phase_spline.h"

namespace millstudy::identify {
namespace {

using Kind = Parameter::Kind;

constexpr std::ptrdiff_t kStretch = 4096;  // samples: the Jacobian of thirty columns fits a cache
constexpr std::ptrdiff_t kKernelGrain = 256;  // samples that pay for preparing an edge

/// d force / d parameter of the cut itself at one sample.
///
/// @param time    after the middle of the record [s]
/// @param spline  of the sample
force::Sensitivity::Vector column_of(const Parameter& p, const force::Sensitivity& at,
                                     const RecordState& state, double feed, double time,
                                     const SplinePlace& spline) {
  switch (p.kind) {
    case Kind::coefficient:
      return at.coefficient[p.index];
    case Kind::size_exponent:
      return at.exponent;
    case Kind::phase:
      return at.angle;
    case Kind::runout:
      return at.runout[p.index];
    case Kind::spindle_speed: {
      force::Sensitivity::Vector column;
      for (int row = 0; row < 3; ++row) {
        column[row] = at.angle[row] * time - at.feed[row] * feed / state.spindle_speed;
      }
      return column;
    }
    case Kind::phase_drift: {
      force::Sensitivity::Vector column{};
      const int place = p.index - spline.first;
      if (place < 0 || place > 3) return column;
      for (int row = 0; row < 3; ++row) column[row] = at.angle[row] * spline.weight[place];
      return column;
    }
    default:
      return {};
  }
}

/// (D40) applied to forces and to their derivatives, stretch after stretch.
class Dynamometer {
 public:
  Dynamometer(const RecordState& state, std::span<const Parameter> parameters,
              const std::vector<int>& axes, double sampling_rate)
      : state_(state), parameters_(parameters), axes_(axes) {
    for (const int axis : axes) {
      std::vector<Mode>& modes = modes_.emplace_back();
      for (const dynamics::DynamometerMode& m : state.dynamometer[axis]) {
        modes.push_back({dynamics::ModeFilter(m.mode, 1.0 / sampling_rate), {}, {}});
        modes.back().columns.resize(parameters.size());
        const double decay = m.mode.damping_ratio * m.mode.natural_frequency / sampling_rate;
        const double samples = std::min(kLongest, kForgotten / decay);
        warm_up_ = std::max(warm_up_, static_cast<std::ptrdiff_t>(samples) + 1);
      }
    }
  }

  /// Samples after which nothing is left of how the filters began.
  std::ptrdiff_t warm_up() const { return warm_up_; }

  void transmit(Stretch& stretch) {
    const Eigen::Index count = stretch.samples;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      if (modes_[a].empty()) continue;
      const Eigen::Index from = static_cast<Eigen::Index>(a) * count;
      tbb::parallel_for(std::size_t{0}, parameters_.size(), [&](std::size_t c) {
        if (is_mode(parameters_[c]) || is_added(parameters_[c])) return;
        transmit_column(a, c,
                        stretch.jacobian.col(static_cast<Eigen::Index>(c)).segment(from, count));
      });
      transmit_force(a, stretch);
    }
  }

 private:
  static constexpr double kForgotten = 20.0;  // exp(-20) = 2e-9
  static constexpr double kLongest = 20000.0;

  static bool is_mode(const Parameter& p) {
    return p.kind == Kind::mode_frequency || p.kind == Kind::mode_damping ||
           p.kind == Kind::mode_gain;
  }
  /// It is added to the signal, behind the dynamometer.
  static bool is_added(const Parameter& p) {
    return p.kind == Kind::offset || p.kind == Kind::drift;
  }

  void transmit_column(std::size_t a, std::size_t c, Eigen::Ref<Eigen::VectorXd> column) {
    const std::vector<double> force(column.begin(), column.end());
    for (std::size_t m = 0; m < modes_[a].size(); ++m) {
      Mode& mode = modes_[a][m];
      mode.filter.add_share(mode.columns[c], state_.dynamometer[axes_[a]][m].gain, force,
                            {column.data(), force.size()});
    }
  }

  /// The force, and its derivatives by what the modes are.
  void transmit_force(std::size_t a, Stretch& stretch) {
    const Eigen::Index count = stretch.samples;
    const Eigen::Index from = static_cast<Eigen::Index>(a) * count;
    const Eigen::VectorXd force = stretch.predicted.segment(from, count);
    for (std::size_t m = 0; m < modes_[a].size(); ++m) {
      Mode& mode = modes_[a][m];
      const double gain = state_.dynamometer[axes_[a]][m].gain;
      std::array<double*, 3> by{};  // gain, frequency, damping
      for (std::size_t c = 0; c < parameters_.size(); ++c) {
        const Parameter& p = parameters_[c];
        if (!is_mode(p) || p.axis != axes_[a] || p.index != static_cast<int>(m)) continue;
        by[p.kind == Kind::mode_gain        ? 0
           : p.kind == Kind::mode_frequency ? 1
                                            : 2] =
            &stretch.jacobian(from, static_cast<Eigen::Index>(c));
      }
      for (Eigen::Index i = 0; i < count; ++i) {
        const double deviation = mode.filter.next_deviation(mode.force, force[i]);
        stretch.predicted[from + i] += gain * deviation;
        if (by[0]) by[0][i] = deviation;
        if (by[1]) by[1][i] = gain * mode.force.position_by[0];
        if (by[2]) by[2][i] = gain * mode.force.position_by[1];
      }
    }
  }

  struct Mode {
    dynamics::ModeFilter filter;
    dynamics::ModeFilter::GradientState force;
    std::vector<dynamics::ModeFilter::State> columns;
  };
  const RecordState& state_;
  std::span<const Parameter> parameters_;
  const std::vector<int>& axes_;
  std::vector<std::vector<Mode>> modes_;  ///< by fitted axis
  std::ptrdiff_t warm_up_ = 0;
};

}  // namespace

RecordModel::RecordModel(const cutter::Cutter& cutter, const Record& record,
                         const FitSettings& settings)
    : cutter_(cutter),
      record_(record),
      wanted_{settings.model == Model::per_height, settings.model == Model::exponential},
      below_(settings.below) {
  for (int axis = 0; axis < 3; ++axis) {
    if (settings.axes[axis] && record.trace.has_axis(axis)) axes_.push_back(axis);
  }
  for (const int axis : axes_) {
    if (below_ > 0.0) measured_below_.push_back(thinned(record.trace.force[axis]));
  }
}

std::vector<double> RecordModel::thinned(std::span<const double> signal) const {
  const double rate = record_.trace.sampling_rate;
  return low_pass(signal, below_, rate,
                  std::max<std::size_t>(1, static_cast<std::size_t>(rate / (4.0 * below_))));
}

void RecordModel::for_each_stretch(const RecordState& state, std::span<const Parameter> parameters,
                                   const std::function<void(Stretch&)>& visit) const {
  if (!(below_ > 0.0)) return for_each_sample(state, parameters, visit);
  // By axis and column, the predicted force last.
  const auto columns = static_cast<Eigen::Index>(parameters.size());
  std::vector<Eigen::MatrixXd> whole(
      axes_.size(), Eigen::MatrixXd(static_cast<Eigen::Index>(samples()), columns + 1));
  for_each_sample(state, parameters, [&](Stretch& stretch) {
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const auto row = static_cast<Eigen::Index>(a) * stretch.samples;
      const auto first = static_cast<Eigen::Index>(stretch.first);
      whole[a].block(first, 0, stretch.samples, columns) =
          stretch.jacobian.middleRows(row, stretch.samples);
      whole[a].col(columns).segment(first, stretch.samples) =
          stretch.predicted.segment(row, stretch.samples);
    }
  });
  Stretch low;
  low.samples = static_cast<int>(residuals());
  const Eigen::Index rows = low.samples;
  low.residual.resize(static_cast<Eigen::Index>(axes_.size()) * rows);
  low.predicted.resize(low.residual.size());
  low.jacobian.resize(low.residual.size(), columns);
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    const Eigen::Index row = static_cast<Eigen::Index>(a) * rows;
    tbb::parallel_for(Eigen::Index{0}, columns + 1, [&](Eigen::Index c) {
      const std::vector<double> column =
          thinned({whole[a].col(c).data(), static_cast<std::size_t>(whole[a].rows())});
      const auto thin = Eigen::Map<const Eigen::VectorXd>(column.data(), rows);
      if (c < columns) {
        low.jacobian.col(c).segment(row, rows) = thin;
      } else {
        low.predicted.segment(row, rows) = thin;
      }
    });
    low.residual.segment(row, rows) =
        low.predicted.segment(row, rows) -
        Eigen::Map<const Eigen::VectorXd>(measured_below_[a].data(), rows);
  }
  visit(low);
}

double RecordModel::middle() const {
  return 0.5 * static_cast<double>(samples() - 1) / record_.trace.sampling_rate;
}

double RecordModel::feed_per_tooth(double spindle_speed) const {
  return record_.feed_rate * core::kTurn / (spindle_speed * cutter_.flutes);
}

double RecordModel::angle_at(const RecordState& state, double sample) const {
  const double time = sample / record_.trace.sampling_rate - middle();
  double angle = state.phase + state.spindle_speed * time;
  if (!state.phase_drift.empty()) {
    const double part = std::clamp(sample / static_cast<double>(samples() - 1), 0.0, 1.0);
    const SplinePlace place = spline_place(part, static_cast<int>(state.phase_drift.size()));
    for (int i = 0; i < 4; ++i) angle += place.weight[i] * state.phase_drift[place.first + i];
  }
  return angle;
}

void RecordModel::for_each_sample(const RecordState& state, std::span<const Parameter> parameters,
                                  const std::function<void(Stretch&)>& visit) const {
  cutter::Cutter cutter = cutter_;
  cutter.runout.offset = std::hypot(state.runout[0], state.runout[1]);
  cutter.runout.angle = std::atan2(state.runout[1], state.runout[0]);
  const double feed = feed_per_tooth(state.spindle_speed);
  const auto size = static_cast<std::ptrdiff_t>(samples());
  const auto columns = static_cast<Eigen::Index>(parameters.size());
  const double last = static_cast<double>(std::max<std::ptrdiff_t>(1, size - 1));
  const double rate = record_.trace.sampling_rate;
  const double half = middle();

  Dynamometer dynamometer(state, parameters, axes_, rate);
  Stretch stretch;
  const std::ptrdiff_t warm_up = dynamometer.warm_up();
  for (std::ptrdiff_t first = -warm_up; first < size;) {
    const std::ptrdiff_t count = std::min(kStretch, (first < 0 ? 0 : size) - first);
    const auto rows = static_cast<Eigen::Index>(axes_.size()) * count;
    stretch.samples = static_cast<int>(count);
    stretch.residual.resize(rows);
    stretch.predicted.resize(rows);
    stretch.jacobian.resize(rows, columns);
    const auto compute = [&](const tbb::blocked_range<std::ptrdiff_t>& range) {
      force::ForceSensitivity kernel(cutter, record_.engagement, wanted_);
      for (std::ptrdiff_t i = range.begin(); i < range.end(); ++i) {
        const auto sample = static_cast<double>(first + i);
        const force::Sensitivity at = kernel.at(angle_at(state, sample), feed, state.coefficients);
        const double time = sample / rate - half;
        const SplinePlace spline = state.phase_drift.empty()
                                       ? SplinePlace{}
                                       : spline_place(std::clamp(sample / last, 0.0, 1.0),
                                                      static_cast<int>(state.phase_drift.size()));
        for (std::size_t a = 0; a < axes_.size(); ++a) {
          stretch.predicted[static_cast<Eigen::Index>(a) * count + i] = at.force[axes_[a]];
        }
        for (Eigen::Index c = 0; c < columns; ++c) {
          const auto column = column_of(parameters[c], at, state, feed, time, spline);
          for (std::size_t a = 0; a < axes_.size(); ++a) {
            stretch.jacobian(static_cast<Eigen::Index>(a) * count + i, c) = column[axes_[a]];
          }
        }
      }
    };
    tbb::parallel_for(tbb::blocked_range<std::ptrdiff_t>(0, count, kKernelGrain), compute,
                      tbb::simple_partitioner());
    dynamometer.transmit(stretch);
    if (first >= 0) {
      stretch.first = static_cast<std::size_t>(first);
      for (std::size_t a = 0; a < axes_.size(); ++a) {
        const int axis = axes_[a];
        const std::vector<double>& measured = record_.trace.force[axis];
        for (std::ptrdiff_t i = 0; i < count; ++i) {
          const double time = static_cast<double>(first + i) / rate - half;
          const Eigen::Index row = static_cast<Eigen::Index>(a) * count + i;
          stretch.predicted[row] += state.offset[axis] + state.drift[axis] * time;
          stretch.residual[row] = stretch.predicted[row] - measured[first + i];
          for (Eigen::Index c = 0; c < columns; ++c) {
            const Parameter& p = parameters[c];
            if (p.axis != axis) continue;
            if (p.kind == Kind::offset) stretch.jacobian(row, c) = 1.0;
            if (p.kind == Kind::drift) stretch.jacobian(row, c) = time;
          }
        }
      }
      visit(stretch);
    }
    first += count;
  }
}

}  // namespace millstudy::identify
