// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

#include "dynamics/delay_system.h"
#include "dynamics/periodic_motion.h"

namespace millstudy::dynamics {

/// (D30), (D31): the periodic vibration of a stable cut under the force of its feed, the fixed
/// point of the map of a period; regeneration included.
///
/// By collocation of rising order until two motions differ by less than a tenth of the tolerance.
/// Measured against the frequency response, where equal flutes have no regeneration: 8e-7 of the
/// largest displacement, most of it of the reference; against the simulation in time: 2e-3.
/// Where the force is not smooth within an element, as at the tip of a ball, and where delays are
/// not the period, the order does not help: tolerances below 1e-5 may not be reached.
/// Throws core::CaseError where no order is enough, which cuts that are not stable may do.
///
/// @param force      on the rigid tool along x, y [N], periodic; smooth but at the system's breaks
/// @param tolerance  of the motion, relative to its largest displacement; 1e-12 .. 0.1
PeriodicMotion forced_vibration(const DelaySystem& system,
                                const std::function<Eigen::Vector2d(double t)>& force,
                                double tolerance);

}  // namespace millstudy::dynamics
