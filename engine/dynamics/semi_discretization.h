// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/arnoldi.h"
#include "dynamics/delay_system.h"

namespace millstudy::dynamics {

struct SemiDiscretization {
  int intervals = 40;  ///< p, of the period, >= 1
  int order = 0;       ///< of the polynomial for the delayed position in an interval, 0, 1, 2
};

/// (D9)-(D11): the map of a state and its history over one period, by semi-discretization.
///
/// Gains are averaged over each interval, exactly; between its ends the state then follows the
/// matrix exponential. Order 0 takes the delayed position as constant, that of the middle of the
/// interval by the line through its two neighbours: for a whole number of intervals their mean.
/// Order 1 takes the line, order 2 a parabola. The map is a sequence of p small products and a
/// shift: its cost is linear in p.
/// Vectors are [u at the r times before, oldest first; state], r the longest delay in intervals.
class SemiDiscretizedMap {
 public:
  /// Throws core::InputError for a number of intervals or an order out of range, and for intervals
  /// longer than the shortest delay.
  SemiDiscretizedMap(const DelaySystem& system, const SemiDiscretization& settings);

  int size() const { return states_ + moving_ * history_; }
  void apply(const double* in, double* out) const;
  LinearMap map() const;

  /// (D13): the positions of one period under a vector of the map, times i T/p, shape (m, p).
  Eigen::MatrixXcd motion(const Eigen::VectorXcd& vector) const;

 private:
  struct Tap {
    int back;          // positions back in time
    double weight[3];  // of sigma^0, sigma^1, sigma^2
  };
  void add_taps(double delay_in_steps, int order);
  void run(const double* in, std::vector<double>& positions, double* state) const;
  void run_one_mode(double* u, double* state) const;
  template <int States, int Moving, int Terms>
  void run_sized(double* u, double* state) const;

  int states_, moving_, intervals_, terms_;
  int history_ = 0;
  std::vector<int> first_tap_;  // of each delay, and the end
  std::vector<Tap> taps_;
  // Of interval i: exponential n x n, then n x m for each term, then the gains m x m of each delay.
  std::vector<double> steps_;
  int stride_ = 0;
  Eigen::MatrixXd c_;
};

}  // namespace millstudy::dynamics
