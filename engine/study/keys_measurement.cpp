// SPDX-License-Identifier: MIT
// Keys of [measurement] and what must hold between them.
#include <fmt/core.h>

#include "study/key_table.h"
#include "study/kind.h"

namespace millstudy::study {

using namespace table;

// clang-format off

std::span<const Key> measurement_keys() {
  constexpr Count kAxes = {3, 3};
  static const std::vector<Key> keys = {
      {"measurement.sampling_rate_Hz", kNumber, "Hz", up_to(1e7), Optional{},
       "sampling rate: the trace is then a record as a dynamometer would give it", MILLSTUDY_SETS(measurement.sampling_rate)},
      {"measurement.duration_s", kNumber, "s", up_to(1e4), 0.0,
       "duration: of the record", MILLSTUDY_SETS(measurement.duration)},
      {"measurement.phase_deg", kNumber, "deg", within(1e6), 0.0,
       "phase: immersion angle of flute 0's tip at the first sample", MILLSTUDY_SETS(measurement.phase)},
      {"measurement.spindle_speed_error_percent", kNumber, "%", within(50.0), 0.0,
       "spindle speed error: by which the spindle is faster than commanded", MILLSTUDY_SETS(measurement.spindle_speed_error)},
      {"measurement.noise_N", kNumber, "N", {0.0, 1e6}, 0.0,
       "noise: standard deviation of normal noise on every axis", MILLSTUDY_SETS(measurement.noise)},
      {"measurement.noise_correlation", kNumber, "", {0.0, 1.0, false, true}, 0.0,
       "noise correlation: of neighbouring samples; 0 is white", MILLSTUDY_SETS(measurement.noise_correlation)},
      {"measurement.offset_N", kNumbers, "N", within(1e6), Optional{},
       "offset: of the signals along x, y, z at the first sample", MILLSTUDY_SETS(measurement.offset), {}, {}, kAxes},
      {"measurement.drift_N_per_s", kNumbers, "N/s", within(1e6), Optional{},
       "drift: of the signals along x, y, z", MILLSTUDY_SETS(measurement.drift), {}, {}, kAxes},
      {"measurement.mode_frequency_Hz", kNumbers, "Hz", {0.0, 1e6}, Optional{},
       "dynamometer's natural frequency: along x, y, z; 0: stiff", MILLSTUDY_SETS(measurement.mode_frequency), {}, {}, kAxes},
      {"measurement.mode_damping_ratio", kNumbers, "", {0.0, 1.0, false, true}, Optional{},
       "dynamometer's damping ratio: along x, y, z", MILLSTUDY_SETS(measurement.mode_damping_ratio), {}, {}, kAxes},
      {"measurement.mode_gain", kNumbers, "", within(1e3), Optional{},
       "dynamometer's gain: share of the mode in the signal along x, y, z; 1 where it is not given", MILLSTUDY_SETS(measurement.mode_gain), {}, {}, kAxes},
      {"measurement.seed", kInteger, "", {0.0, 2147483647.0}, 0.0,
       "seed: of the noise; points differ by what else they differ in", MILLSTUDY_SETS(measurement.seed)},
  };
  return keys;
}

// clang-format on

void check_measurement(const Given& given, const Case& base, Faults& faults) {
  constexpr std::string_view kRate = "measurement.sampling_rate_Hz";
  constexpr std::string_view kDuration = "measurement.duration_s";
  if (!given.has(kRate)) {
    for (const Key& key : measurement_keys()) {
      if (!given.has(key.path)) continue;
      return faults.add(given.place({key.path}),
                        fmt::format("{} [Hz] is missing: {} needs it", kRate, key.path));
    }
    return;
  }
  if (!given.has(kDuration)) {
    faults.add(given.place({kRate}),
               fmt::format("{} [s] is missing: {} needs it", kDuration, kRate));
  }
  if (!given.has("output.traces")) {
    faults.add(given.place({kRate}),
               "output.traces = true is missing: what is measured is kept as a trace");
  }
  constexpr std::string_view kFrequency = "measurement.mode_frequency_Hz";
  constexpr std::string_view kDamping = "measurement.mode_damping_ratio";
  if (given.has(kFrequency) != given.has(kDamping)) {
    const auto [there, absent] =
        given.has(kFrequency) ? std::pair{kFrequency, kDamping} : std::pair{kDamping, kFrequency};
    faults.add(given.place({there}), fmt::format("{} is missing: {} needs it", absent, there));
  }
  const double samples = base.measurement.sampling_rate.value_or(0.0) * base.measurement.duration;
  if (!given.any_swept({kRate, kDuration}) && samples > kMostMeasuredSamples) {
    faults.add(given.place({kRate}), kTooManyMeasuredSamples);
  }
}

}  // namespace millstudy::study
