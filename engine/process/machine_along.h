// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "force/figures.h"
#include "force/sampler.h"
#include "path/interpolate.h"
#include "process/machining.h"

namespace millstudy::process {

/// Forces over the whole path, in machine axes.
struct PathForces {
  force::ForceFigures figures;
  double removal_rate =
      0.0;  ///< volume that the arcs take per time, the mean over the path [mm3/s]
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
/// Equations (M1)-(M4), (M10): in period i the tool moves along the chord at v_i = |chord| / T, so
/// feed per tooth is v_i / (n N) and the feed frame is turned by the chord's direction; the spindle
/// angle runs on continuously. A fluctuation of the interpolator is a fluctuation of the force.
/// The engagement of a period is that of PathEngagement; where it is machining.engagement, to the
/// bit, nothing is prepared anew.
///
/// @param path      at least two points; slopes up to force::kSteepestSlope
/// @param sampler   of the same cutter, engagement and angular steps as machining
/// @param observer  may be empty
/// @return statistics over all samples of the path, air included, in N and N mm
/// Accuracy: that of the sampler, and of an engagement that is held over a period: at the ends of a
/// stock 29 mm long chords of R/100 leave 4e-4 of the mean force and 4e-5 of its peak, half as long
/// ones half of that. Statistics are sums over samples, in order.
/// @throws core::CaseError if the path climbs by more than 15 deg, or needs more than 1e9 samples
/// @throws core::InputError for an immersion whose radial depth is out of range
PathForces machine_along(const path::Interpolation& path, const force::ForceSampler& sampler,
                         const Machining& machining, const SampleObserver& observer = {});

}  // namespace millstudy::process
