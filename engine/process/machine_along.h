// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "cutter/cutter.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "force/figures.h"
#include "force/sampler.h"
#include "path/interpolate.h"

namespace millstudy::process {

/// The spindle and the cutter it turns, along a path.
struct Machining {
  cutter::Cutter cutter;
  force::Engagement engagement;
  force::Coefficients coefficients;
  double spindle_speed = 0.0;  ///< n [rev/s], > 0
  int angular_steps = 360;     ///< force samples per revolution
  force::FigureRequest figures = {};
};

/// Forces over the whole path, in machine axes.
struct PathForces {
  force::ForceFigures figures;
  std::int64_t samples = 0;
};

/// Sees the samples of one interpolation period: number of the first, how many, the forces.
using SampleObserver =
    std::function<void(std::int64_t first, std::int64_t count, const force::ForceSamples&)>;

/// First sample at or after the start of period i: sample s is taken at time s / (n S).
///
/// Equation (M2). A sample that falls on the boundary to rounding belongs to the later period.
std::int64_t first_sample_of_period(std::int64_t i, double samples_per_period);

/// The cutting force while the tool follows an interpolated path.
///
/// Equations (M1)-(M4): in period i the tool moves along the chord at v_i = |chord| / T, so feed
/// per tooth is v_i / (n N) and the feed frame is turned by the chord's direction; the spindle
/// angle runs on continuously. A fluctuation of the interpolator is a fluctuation of the force.
///
/// @param path      points in a plane of constant z, at least two
/// @param sampler   of the same cutter, engagement and angular steps as machining
/// @param observer  may be empty
/// @return statistics over all samples of the path, in N and N mm
/// Accuracy: that of the sampler; statistics are sums over samples, in order.
/// @throws core::CaseError if the path climbs, or needs more than 1e9 samples
PathForces machine_along(const path::Interpolation& path, const force::ForceSampler& sampler,
                         const Machining& machining, const SampleObserver& observer = {});

}  // namespace millstudy::process
