// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "dynamics/depth_limit.h"

namespace millstudy::dynamics {

/// The logarithm of the spectral radius over depth, as searches of a boundary see it.
class RadiusProbe {
 public:
  RadiusProbe(const SystemAtDepth& system, const DepthSearch& search, int level)
      : system_(system), search_(search), level_(level) {}

  struct Sample {
    double depth;  ///< [mm]
    double value;  ///< log of the spectral radius: stable below 0
  };

  Sample at(double depth);
  /// The depth between two samples of different sign at which the value is 0 [mm], at a level that
  /// keeps the tolerance.
  double boundary(Sample a, Sample b);

  int evaluations() const { return evaluations_; }
  int level() const { return level_; }

 private:
  Sample root(Sample a, Sample b, double& slope);
  Sample at_level(double depth, int level);

  const SystemAtDepth& system_;
  const DepthSearch& search_;
  int level_;
  int evaluations_ = 0;
  Eigen::VectorXd guess_;
};

}  // namespace millstudy::dynamics
