// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "cutter/cutter.h"
#include "force/engagement.h"
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
  /// Running sums in eight interleaved parts, as vectors take them.
  struct Sums {
    std::array<double, 8> sum;
    std::array<double, 8> squares;
    std::array<double, 8> min;
    std::array<double, 8> max;
  };
  class Taker;
  Statistics statistics(const Sums& sums) const;

  std::int64_t count_ = 0;
  std::array<Sums, 5> sums_;  // x, y, z, resultant, torque
};

/// (F16): the thickest chip that the cut makes [mm].
double largest_chip_thickness(const cutter::Cutter& cutter, const Engagement& engagement,
                              double feed_per_tooth);

}  // namespace millstudy::force
