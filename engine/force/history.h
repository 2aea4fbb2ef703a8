// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "cutter/cutter.h"
#include "force/engagement.h"
#include "force/lanes.h"
#include "force/sampler.h"

namespace millstudy::force {

/// Sample statistics of one quantity; NaN where there was no sample.
struct Statistics {
  double mean;
  double min;
  double max;
  double rms;
};

struct ForceStatistics {
  Statistics x;          ///< [N]
  Statistics y;          ///< [N]
  Statistics z;          ///< [N]
  Statistics resultant;  ///< sqrt(x^2 + y^2 + z^2) of each sample [N]
  double torque_mean;    ///< [N mm]
  double torque_max;     ///< [N mm]
};

/// Statistics of a history that comes in pieces, none of which is kept.
///
/// The order of summation is fixed by the pieces alone, so equal pieces give equal bits.
class StatisticsAccumulator {
 public:
  StatisticsAccumulator();
  /// Takes in the first `count` samples.
  void add(const ForceSamples& samples, std::int64_t count);
  ForceStatistics result() const;

 private:
  struct Sums {
    Lanes sum;
    Lanes squares;
    Lanes min;
    Lanes max;
  };
  static void take(Sums& sums, const Lanes& values);
  static void take(Sums& sums, const Lanes& values, int count);
  Statistics statistics(const Sums& sums) const;

  std::int64_t count_ = 0;
  Sums x_, y_, z_, resultant_, torque_;
};

/// (F16): the thickest chip that the cut makes [mm].
double largest_chip_thickness(const cutter::Cutter& cutter, const Engagement& engagement,
                              double feed_per_tooth);

}  // namespace millstudy::force
