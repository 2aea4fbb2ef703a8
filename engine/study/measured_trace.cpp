// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "identify/synthetic_trace.h"
#include "study/rows.h"

namespace millstudy::study {
namespace {

/// A seed of the point's own: from that of the study and what a sweep of records changes.
std::uint64_t seed_of(const Case& point) {
  std::uint64_t seed = static_cast<std::uint64_t>(point.measurement.seed);
  const auto stir = [&](double value) {
    seed ^= std::bit_cast<std::uint64_t>(value);
    seed += 0x9e3779b97f4a7c15;  // splitmix64, Steele, Lea and Flood
    seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9;
    seed = (seed ^ (seed >> 27)) * 0x94d049bb133111eb;
    seed ^= seed >> 31;
  };
  stir(feed_rate(point));
  stir(point.cut.spindle_speed);
  stir(point.cut.axial_depth);
  stir(point.cut.radial_depth.value_or(0.0));
  stir(point.measurement.phase);
  return seed;
}

}  // namespace

void fill_measured(const Case& point, sweep::Trace& trace) {
  const MeasurementSection& section = point.measurement;
  const double samples = std::floor(*section.sampling_rate * section.duration);
  if (samples > kMostMeasuredSamples) throw core::CaseError(kTooManyMeasuredSamples);
  if (samples < 1.0) throw core::CaseError("measurement.duration_s holds no sample");
  identify::Measurement m;
  m.sampling_rate = *section.sampling_rate;
  m.samples = static_cast<std::size_t>(samples);
  m.feed_rate = feed_rate(point);
  m.spindle_speed = core::kTurn * point.cut.spindle_speed * (1.0 + section.spindle_speed_error);
  m.phase = section.phase;
  for (int axis = 0; axis < 3; ++axis) {
    if (!section.offset.empty()) m.offset[axis] = section.offset[axis];
    if (!section.drift.empty()) m.drift[axis] = section.drift[axis];
    if (section.mode_frequency.empty() || section.mode_frequency[axis] == 0.0) continue;
    const double gain = section.mode_gain.empty() ? 1.0 : section.mode_gain[axis];
    m.dynamometer[axis].push_back(
        {{core::kTurn * section.mode_frequency[axis], section.mode_damping_ratio[axis]}, gain});
  }
  m.noise = section.noise;
  m.correlation = section.noise_correlation;
  m.seed = seed_of(point);
  identify::Trace record;
  try {
    record = identify::synthetic_trace(point.cutter, engagement(point), scaled_coefficients(point),
                                       variation(point), m);
  } catch (const core::InputError& error) {
    throw core::CaseError(error.what());
  }
  const std::size_t size = record.size();
  const auto single = [](const std::vector<double>& values) {
    return std::vector<float>(values.begin(), values.end());
  };
  for (std::size_t i = 0; i < size; ++i) {
    const double time = static_cast<double>(i) / m.sampling_rate;
    trace.time.push_back(static_cast<float>(time));
    trace.angle.push_back(static_cast<float>(m.phase + m.spindle_speed * time));
  }
  trace.force_x = single(record.force[0]);
  trace.force_y = single(record.force[1]);
  trace.force_z = single(record.force[2]);
}

}  // namespace millstudy::study
