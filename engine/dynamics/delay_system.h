// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "dynamics/state_space.h"

namespace millstudy::dynamics {

/// A part of the force that depends on where the tool was: gain times u(t - delay).
struct DelayedGain {
  double delay;          ///< [s], > 0
  Eigen::Matrix2d gain;  ///< [N/mm]; of one moving axis only (0, 0) counts
};

/// The gains at one time: F = -direct u(t) - damping d/dt u(t) + sum of gain u(t - delay).
struct Gains {
  Eigen::Matrix2d direct = Eigen::Matrix2d::Zero();  ///< [N/mm]
  std::vector<DelayedGain> delayed;
  Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();  ///< [N s/mm]
};

/// Averages of the gains over equal intervals of the period; the delays are the same in all.
struct AveragedGains {
  std::vector<double> delays;            ///< [s], shape (d)
  std::vector<Eigen::Matrix2d> direct;   ///< of interval i, shape (intervals)
  std::vector<Eigen::Matrix2d> delayed;  ///< of interval i and delay k at i * d + k
  std::vector<Eigen::Matrix2d> damping;  ///< as direct; empty: none
};

/// (D4): a linear system with delays and periodic gains,
///
///   d/dt s = a s + b (-W(t) u(t) - B(t) d/dt u(t) + sum over k of D_k(t) u(t - tau_k(t))),
///   u = c s.
struct DelaySystem {
  StateSpace machine;
  double period = 0.0;          ///< [s]
  double shortest_delay = 0.0;  ///< [s], > 0
  double longest_delay = 0.0;   ///< [s]
  std::vector<double> breaks;   ///< times 0 <= t < period at which gains are not smooth, ascending
  std::function<Gains(double t)> at;                     ///< t in 0 .. period [s]
  std::function<AveragedGains(int intervals)> averages;  ///< exact averages
};

}  // namespace millstudy::dynamics
