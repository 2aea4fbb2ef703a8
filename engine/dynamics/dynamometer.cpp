// SPDX-License-Identifier: MIT
#include "dynamics/dynamometer.h"

#include <cmath>

namespace millstudy::dynamics {

std::complex<double> transfer(std::span<const DynamometerMode> modes, double frequency) {
  std::complex<double> sum = 1.0;
  for (const DynamometerMode& m : modes) {
    const double part = frequency / m.mode.natural_frequency;
    const std::complex<double> one =
        1.0 / std::complex<double>(1.0 - part * part, 2.0 * m.mode.damping_ratio * part);
    sum += m.gain * (one - 1.0);
  }
  return sum;
}

ModeFilter::ModeFilter(const Mode& mode, double sampling_interval)
    : rate_(1.0 / sampling_interval) {
  check(mode);
  const double w = mode.natural_frequency, z = mode.damping_ratio, t = sampling_interval;
  const double root = std::sqrt(1.0 - z * z);
  const double damped = w * root;
  const double decay = std::exp(-z * w * t);
  const double c = std::cos(damped * t), s = std::sin(damped * t) / damped;
  step_ = {decay * (c + z * w * s), decay * s, -decay * w * w * s, decay * (c - z * w * s)};
  lag_ = 2.0 * z / w;

  const double c_by_damped = -t * damped * s, s_by_damped = (t * c - s) / damped;
  const double damped_by[2] = {root, -w * z / root};
  const double decay_by[2] = {-z * t, -w * t};  // over decay
  const double zw_by[2] = {z, w};
  const double ww_by[2] = {2.0 * w, 0.0};
  lag_by_[0] = -2.0 * z / (w * w);
  lag_by_[1] = 2.0 / w;
  for (int q = 0; q < 2; ++q) {
    const double dc = c_by_damped * damped_by[q], ds = s_by_damped * damped_by[q];
    const double swing = zw_by[q] * s + z * w * ds;
    step_by_[q] = {decay_by[q] * step_.xx + decay * (dc + swing),
                   decay_by[q] * step_.xv + decay * ds,
                   decay_by[q] * step_.vx - decay * (ww_by[q] * s + w * w * ds),
                   decay_by[q] * step_.vv + decay * (dc - swing)};
  }
}

void ModeFilter::add_share(State& state, double gain, std::span<const double> force,
                           std::span<double> signal) const {
  State now = state;
  for (std::size_t i = 0; i < force.size(); ++i) signal[i] += gain * next_deviation(now, force[i]);
  state = now;
}

double ModeFilter::next_deviation(GradientState& gradient, double force) const {
  State& state = gradient.state;
  if (!state.begun) return next_deviation(state, force);
  const double slope = (force - state.force) * rate_;
  const double x = state.position + lag_ * (slope - state.slope);
  const double v = state.velocity - (slope - state.slope);
  for (int q = 0; q < 2; ++q) {
    const double trail = lag_by_[q] * slope;
    const double dx = gradient.position_by[q] + trail;
    const double dv = gradient.velocity_by[q];
    const Step& by = step_by_[q];
    gradient.position_by[q] = step_.xx * dx + step_.xv * dv + by.xx * x + by.xv * v - trail;
    gradient.velocity_by[q] = step_.vx * dx + step_.vv * dv + by.vx * x + by.vv * v;
  }
  return next_deviation(state, force);
}

}  // namespace millstudy::dynamics
