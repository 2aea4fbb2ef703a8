// SPDX-License-Identifier: MIT
#include "identify/synthetic_trace.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "core/error.h"
#include "core/units.h"
#include "force/nonlinear_force.h"

namespace millstudy::identify {
namespace {

/// Normal numbers that are the same with every library (Box and Muller).
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : random_(seed) {}

  double next() {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    const double size = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    const double angle = core::kTurn * uniform();
    second_ = size * std::sin(angle);
    has_second_ = true;
    return size * std::cos(angle);
  }

 private:
  /// 0 <= x < 1
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  std::mt19937_64 random_;
  double second_ = 0.0;
  bool has_second_ = false;
};

void check(const Measurement& m) {
  if (!(m.sampling_rate > 0.0) || !(m.feed_rate > 0.0) || !(m.spindle_speed > 0.0)) {
    throw core::InputError("sampling rate, feed rate and spindle speed must be > 0");
  }
  if (!(m.noise >= 0.0) || !(m.correlation >= 0.0 && m.correlation < 1.0)) {
    throw core::InputError("noise must be >= 0 N, its correlation at least 0 and below 1");
  }
}

/// Samples after which a mode has forgotten how it began, to 1e-16.
std::ptrdiff_t memory(const Measurement& m) {
  constexpr double kForgotten = 37.0, kLongest = 1e6;
  double samples = 0.0;
  for (const auto& modes : m.dynamometer) {
    for (const dynamics::DynamometerMode& mode : modes) {
      const double decay = mode.mode.damping_ratio * mode.mode.natural_frequency / m.sampling_rate;
      samples = std::max(samples, std::min(kLongest, kForgotten / decay));
    }
  }
  return static_cast<std::ptrdiff_t>(samples);
}

}  // namespace

void add_noise(Trace& trace, double deviation, double correlation, std::uint64_t seed) {
  if (deviation == 0.0) return;
  Normal normal(seed);
  for (std::vector<double>& force : trace.force) {
    if (force.empty()) continue;
    double noise = normal.next();
    for (double& f : force) {
      f += deviation * noise;
      noise = correlation * noise + std::sqrt(1.0 - correlation * correlation) * normal.next();
    }
  }
}

Trace synthetic_trace(const cutter::Cutter& cutter, const force::Engagement& engagement,
                      const force::Coefficients& coefficients, const force::Variation& variation,
                      const Measurement& measurement) {
  const Measurement& m = measurement;
  force::check(cutter, engagement);
  check(m);
  const auto edges =
      std::make_shared<const force::CuttingEdges>(cutter, engagement.axial_depth, variation);
  const force::NonlinearForce kernel(edges, {});
  const force::Arc arc = engagement.arc();
  const force::Feed feed = {m.feed_rate * core::kTurn / (m.spindle_speed * cutter.flutes)};
  std::array<std::vector<dynamics::ModeFilter>, 3> filters;
  std::array<std::vector<dynamics::ModeFilter::State>, 3> states;
  for (int axis = 0; axis < 3; ++axis) {
    for (const dynamics::DynamometerMode& mode : m.dynamometer[axis]) {
      filters[axis].emplace_back(mode.mode, 1.0 / m.sampling_rate);
    }
    states[axis].resize(filters[axis].size());
  }
  Trace trace{"synthetic", m.sampling_rate, 0.0, {}};
  for (std::vector<double>& force : trace.force) force.reserve(m.samples);
  for (std::ptrdiff_t i = -memory(m); i < static_cast<std::ptrdiff_t>(m.samples); ++i) {
    const double time = static_cast<double>(i) / m.sampling_rate;
    const double angle = m.phase + m.spindle_speed * time;
    std::array<double, force::kRows> sum{};
    for (std::size_t j = 0; j < edges->flutes().size(); ++j) {
      const auto of_flute =
          kernel.of_flute(static_cast<int>(j), angle + edges->flutes()[j].position, {&arc, 1},
                          coefficients, feed, force::Rows::forces);
      for (int row = 0; row < 3; ++row) sum[row] += of_flute[row];
    }
    for (int axis = 0; axis < 3; ++axis) {
      double signal = sum[axis];
      for (std::size_t k = 0; k < filters[axis].size(); ++k) {
        const double deviation = filters[axis][k].next_deviation(states[axis][k], sum[axis]);
        signal += m.dynamometer[axis][k].gain * deviation;
      }
      if (i >= 0) trace.force[axis].push_back(signal + m.offset[axis] + m.drift[axis] * time);
    }
  }
  add_noise(trace, m.noise, m.correlation, m.seed);
  return trace;
}

}  // namespace millstudy::identify
