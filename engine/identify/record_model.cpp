// SPDX-License-Identifier: MIT
#include "identify/record_model.h"

#include <algorithm>
#include <cmath>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/units.h"
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

}  // namespace

RecordModel::RecordModel(const cutter::Cutter& cutter, const Record& record,
                         const FitSettings& settings)
    : cutter_(cutter),
      record_(record),
      wanted_{settings.model == Model::per_height, settings.model == Model::exponential} {
  for (int axis = 0; axis < 3; ++axis) {
    if (settings.axes[axis] && record.trace.has_axis(axis)) axes_.push_back(axis);
  }
}

double RecordModel::middle() const {
  return 0.5 * static_cast<double>(samples() - 1) / record_.trace.sampling_rate;
}

double RecordModel::feed_per_tooth(double spindle_speed) const {
  return record_.feed_rate * 2.0 * core::kPi / (spindle_speed * cutter_.flutes);
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

void RecordModel::for_each_stretch(const RecordState& state, std::span<const Parameter> parameters,
                                   const std::function<void(Stretch&)>& visit) const {
  cutter::Cutter cutter = cutter_;
  cutter.runout.offset = std::hypot(state.runout[0], state.runout[1]);
  cutter.runout.angle = std::atan2(state.runout[1], state.runout[0]);
  const double feed = feed_per_tooth(state.spindle_speed);
  const auto size = static_cast<std::ptrdiff_t>(samples());
  const auto columns = static_cast<Eigen::Index>(parameters.size());
  const double last = static_cast<double>(std::max<std::ptrdiff_t>(1, size - 1));
  const double rate = record_.trace.sampling_rate;

  Stretch stretch;
  for (std::ptrdiff_t first = 0; first < size; first += kStretch) {
    const std::ptrdiff_t count = std::min(kStretch, size - first);
    const auto rows = static_cast<Eigen::Index>(axes_.size()) * count;
    stretch.first = static_cast<std::size_t>(first);
    stretch.samples = static_cast<int>(count);
    stretch.residual.resize(rows);
    stretch.predicted.resize(rows);
    stretch.jacobian.resize(rows, columns);
    const auto compute = [&](const tbb::blocked_range<std::ptrdiff_t>& range) {
      force::ForceSensitivity kernel(cutter, record_.engagement, wanted_);
      for (std::ptrdiff_t i = range.begin(); i < range.end(); ++i) {
        const auto sample = static_cast<double>(first + i);
        const force::Sensitivity at = kernel.at(angle_at(state, sample), feed, state.coefficients);
        const double time = sample / rate - middle();
        const SplinePlace spline =
            state.phase_drift.empty()
                ? SplinePlace{}
                : spline_place(sample / last, static_cast<int>(state.phase_drift.size()));
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
    // What the dynamometer does, then what is added to its signal.
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const int axis = axes_[a];
      const std::vector<double>& measured = record_.trace.force[axis];
      for (std::ptrdiff_t i = 0; i < count; ++i) {
        const double time = static_cast<double>(first + i) / rate - middle();
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
}

}  // namespace millstudy::identify
