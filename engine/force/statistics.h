// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

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
  Statistics x;             ///< [N]
  Statistics y;             ///< [N]
  Statistics z;             ///< [N]
  Statistics resultant;     ///< sqrt(x^2 + y^2 + z^2) of each sample [N]
  double torque_mean;       ///< [N mm]
  double torque_max;        ///< [N mm]
  double cutting_fraction;  ///< of the samples in which any tooth cuts [1]
};

/// Statistics of a history that comes in pieces, none of which is kept.
///
/// The order of summation is fixed by the pieces and the instruction set, so that equal pieces give
/// equal bits on machines of one kind.
class StatisticsAccumulator {
 public:
  StatisticsAccumulator();
  /// Takes in the first `count` samples.
  void add(const ForceSamples& samples, std::int64_t count);
  ForceStatistics result() const;

 private:
  static constexpr int kParts = 8;
  /// Running sums in interleaved parts, as vectors take them: as many as the longest has lanes.
  struct Sums {
    std::array<double, kParts> sum;
    std::array<double, kParts> squares;
    std::array<double, kParts> min;
    std::array<double, kParts> max;
  };
  class Taker;
  Statistics statistics(const Sums& sums) const;

  std::int64_t count_ = 0;
  std::int64_t cutting_ = 0;  // samples with a force
  std::array<Sums, 5> sums_;  // x, y, z, resultant, torque
};

}  // namespace millstudy::force
