// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace millstudy::dynamics {

/// A motion of the tool that repeats, as a polynomial in each element of its period.
class PeriodicMotion {
 public:
  /// No motion.
  explicit PeriodicMotion(double period) : period_(period) {}

  /// @param starts     of the elements, ascending from 0 [s]
  /// @param nodes      Gauss nodes in each, 2 .. 16
  /// @param axes       which of x (0), y (1) move
  /// @param positions  at the start and the nodes of each element; shape (elements, nodes + 1,
  /// axes)
  PeriodicMotion(double period, std::vector<double> starts, int nodes, std::vector<int> axes,
                 std::vector<double> positions);

  /// From equally spaced positions of one period, by the cubic through four of them.
  PeriodicMotion(double period, std::vector<Eigen::Vector2d> samples);

  double period() const { return period_; }
  /// Displacement of the tool x, y [mm] at any time [s].
  Eigen::Vector2d at(double t) const;
  /// The largest displacement of the points that it is made of [mm].
  double largest() const;

 private:
  double period_;
  std::vector<double> starts_;
  int nodes_ = 0;
  std::vector<int> axes_;
  std::vector<double> positions_;
  std::vector<Eigen::Vector2d> samples_;
};

}  // namespace millstudy::dynamics
