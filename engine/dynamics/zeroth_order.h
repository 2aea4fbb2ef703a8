// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "dynamics/machine.h"
#include "dynamics/measured_response.h"
#include "dynamics/regenerative_cut.h"

namespace millstudy::dynamics {

/// What the frequency method needs to know of a machine.
struct FrequencyDomain {
  std::function<Eigen::Matrix2cd(double omega)> response;  ///< [mm/N]
  std::vector<double> omega;  ///< ascending, close enough for the response to be followed [rad/s]
};

/// Of modes, of measured responses, or of both in series: tool measured, workpiece by its modes.
/// Throws core::InputError for what check() finds in either, and where there is neither.
FrequencyDomain frequency_domain(const Machine& machine, const MeasuredAxes& measured = {});

/// Where the loop closes at a real gain.
struct ZerothOrder {
  double gain = 0.0;               ///< of the mean stiffness at the boundary [1]; infinite: none
  double chatter_frequency = 0.0;  ///< [rad/s]
};

/// (D20), (D21): the lowest factor of the mean directional matrix at which the averaged cut is at
/// the boundary of stability (Y. Altintas, E. Budak, CIRP Annals 44 (1995) 357-362), for a given
/// delay: roots over frequency are bracketed on a grid of 32 points a turn of the delay.
///
/// Exact where the directional matrix is constant, as in a slot with an even number, from 4 up, of
/// equal teeth; there its limits and those of collocation differ by less than 1e-6 (measured).
/// @param mean_stiffness  [N/mm] at some depth; rows and columns x, y
/// @param delay           [s], > 0
/// @param mean_damping    [N s/mm] at the same depth
ZerothOrder zeroth_order_gain(const FrequencyDomain& machine, const Eigen::Matrix2d& mean_stiffness,
                              double delay,
                              const Eigen::Matrix2d& mean_damping = Eigen::Matrix2d::Zero());

struct ZerothOrderLimit {
  double axial_depth_limit = 0.0;  ///< [mm]; largest_depth where it is stable up to there
  double chatter_frequency = 0.0;  ///< [rad/s]; 0 without limit
};

/// (D22): the depth limit of the averaged cut. Of equal flutes; throws core::InputError otherwise.
///
/// The mean matrix is linear in depth on cylinders, where one gain is enough; elsewhere the depth
/// at which the gain is one is found by bisection, to 1e-6 of it.
/// @param process_damping  C of (D26) [N/mm], >= 0
ZerothOrderLimit zeroth_order_limit(const FrequencyDomain& machine, const cutter::Cutter& cutter,
                                    const force::Arc& arc, const force::Coefficients& coefficients,
                                    double spindle_speed, double largest_depth,
                                    const force::Variation& variation = {},
                                    double process_damping = 0.0);

}  // namespace millstudy::dynamics
