// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cutter/cutter.h"
#include "dynamics/dynamometer.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "force/variation.h"
#include "identify/trace.h"

namespace millstudy::identify {

/// How a cut is measured: what fits have to find out again.
struct Measurement {
  double sampling_rate = 10000.0;  ///< [Hz], > 0
  std::size_t samples = 10000;
  double feed_rate = 0.0;      ///< [mm/s], > 0
  double spindle_speed = 0.0;  ///< the actual one [rad/s], > 0
  double phase = 0.0;          ///< immersion angle of flute 0's tip at the first sample [rad]
  std::array<std::vector<dynamics::DynamometerMode>, 3> dynamometer = {};  ///< along x, y, z
  std::array<double, 3> offset{};  ///< at the first sample [N]
  std::array<double, 3> drift{};   ///< [N/s]
  double noise = 0.0;              ///< standard deviation [N]
  double correlation = 0.0;        ///< of the noise of neighbouring samples, 0 .. 1
  std::uint64_t seed = 0;          ///< of the noise; the same seed gives the same noise anywhere
};

/// A trace as a dynamometer would give it, (I12): forces by NonlinearForce, which fits do not use,
/// transmitted by the dynamometer, then offset, drift and normal noise, all in double precision.
///
/// Before the first sample the cut has been going on for as long as the dynamometer remembers.
/// Throws core::InputError for a cutter, an engagement or a measurement out of range.
Trace synthetic_trace(const cutter::Cutter& cutter, const force::Engagement& engagement,
                      const force::Coefficients& coefficients, const force::Variation& variation,
                      const Measurement& measurement);

/// Adds normal noise to every axis of a trace.
///
/// @param deviation    standard deviation [N]
/// @param correlation  of neighbouring samples, 0 <= correlation < 1
void add_noise(Trace& trace, double deviation, double correlation, std::uint64_t seed);

}  // namespace millstudy::identify
