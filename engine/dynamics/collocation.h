// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

#include "dynamics/arnoldi.h"
#include "dynamics/delay_system.h"
#include "dynamics/periodic_motion.h"

namespace millstudy::dynamics {

struct Collocation {
  int nodes = 8;              ///< of each element, 2 .. 16
  double longest_turn = 4.0;  ///< of the fastest mode within an element [rad], > 0
};

/// (D14): the map of a state and its history over one period by collocation at Gauss nodes, of
/// elements that end where gains are not smooth.
///
/// With one delay that is the period, elements and history fit, and the error of the multipliers
/// falls with the power 2 nodes of the element's length; else the delayed position is interpolated
/// by the polynomial of its element and the power is nodes + 1 where the motion is smooth.
/// Vectors are [u at start and nodes of the elements before, oldest first; state].
class CollocationMap {
 public:
  CollocationMap(const DelaySystem& system, const Collocation& settings);

  int size() const { return states_ + moving_ * history_; }
  int elements() const { return static_cast<int>(elements_.size()); }
  void apply(const double* in, double* out) const;
  LinearMap map() const;

  /// (D30): a force on the tool [N] at the nodes of all elements, as apply() takes it.
  std::vector<double> force_at_nodes(const std::function<Eigen::Vector2d(double t)>& force) const;
  /// apply() under such a force.
  void apply(const double* in, double* out, const std::vector<double>& force) const;
  /// The motion of that period.
  PeriodicMotion motion(const double* in, const std::vector<double>& force) const;

  /// (D13): Fourier coefficients of the motion under a vector with this multiplier: of the
  /// harmonics -harmonics .. harmonics of the period on top of the multiplier's own frequency;
  /// shape (m, 2 harmonics + 1).
  Eigen::MatrixXcd spectrum(const Eigen::VectorXcd& vector, std::complex<double> multiplier,
                            int harmonics) const;

 private:
  struct Tap {
    int node;              // of the element, at which the force acts
    int place;             // among the positions, from the element's first; < 0
    Eigen::Matrix2d gain;  // with the weight of the interpolation
  };
  struct Element {
    double start, length;  // [s]
    std::vector<Tap> taps;
    /// [u at the nodes; new state] = step [state; delayed force at the nodes].
    Eigen::MatrixXd step;
  };
  void add_stretch(const DelaySystem& system, double start, double end, double longest);
  void add_taps(int element, int node, double time, const DelayedGain& delayed);
  void run(const double* in, std::vector<double>& positions, double* state,
           const double* force = nullptr) const;

  int states_, moving_, nodes_;
  std::vector<int> axes_;
  int history_ = 0;  // positions
  double period_;
  std::vector<Element> elements_;
  Eigen::MatrixXd c_;
};

}  // namespace millstudy::dynamics
