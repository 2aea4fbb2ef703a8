// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/units.h"
#include "identify/fit.h"
#include "identify/synthetic_trace.h"

/// Measured forces that are known to the last digit, by a kernel that fits do not use.
namespace millstudy::identify::testing {

/// How a record is made.
struct Truth {
  cutter::Cutter cutter;  ///< with its runout
  force::Engagement engagement;
  force::Coefficients coefficients;
  force::Variation variation = {};
  double feed_rate = 10.0;      ///< [mm/s]
  double spindle_speed = 80.0;  ///< [rad/s]
  double phase = 0.0;           ///< of the tip of flute 0 at the first sample [rad]
  std::array<double, 3> offset{};
  std::array<std::vector<dynamics::DynamometerMode>, 3> dynamometer = {};
  double sampling_rate = 5000.0;
  std::size_t samples = 1500;
};

inline Record make_record(const Truth& truth, const std::string& name) {
  Measurement measurement;
  measurement.sampling_rate = truth.sampling_rate;
  measurement.samples = truth.samples;
  measurement.feed_rate = truth.feed_rate;
  measurement.spindle_speed = truth.spindle_speed;
  measurement.phase = truth.phase;
  measurement.offset = truth.offset;
  measurement.dynamometer = truth.dynamometer;
  return {name,
          synthetic_trace(truth.cutter, truth.engagement, truth.coefficients, truth.variation,
                          measurement),
          truth.engagement, truth.feed_rate, truth.spindle_speed};
}

/// A two-flute slot of GGG-70 with runout.
inline Truth slot_truth() {
  Truth truth;
  truth.cutter = {cutter::Shape::bull_nose, 16.0, 2, core::rad_from_deg(25.0)};
  truth.cutter.corner_radius = 3.0;
  truth.cutter.runout = {0.012, 0.7};
  truth.engagement = force::slot(2.0);
  truth.coefficients = {2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};
  truth.phase = 1.234;
  return truth;
}

inline std::array<double, 6> values(const force::Coefficients& k) {
  return {k.Ktc, k.Krc, k.Kac, k.Kte, k.Kre, k.Kae};
}

}  // namespace millstudy::identify::testing
