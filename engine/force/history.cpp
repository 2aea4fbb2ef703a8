// SPDX-License-Identifier: MIT
#include "force/history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "cutter/envelope.h"

namespace millstudy::force {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The first `count` lanes of memory, the others zero.
Lanes load_part(const double* from, int count) {
  Lanes lanes{};
  for (int i = 0; i < count; ++i) lanes[i] = from[i];
  return lanes;
}

double total(const Lanes& lanes) {
  double sum = 0.0;
  for (int i = 0; i < kLanes; ++i) sum += lanes[i];
  return sum;
}

}  // namespace

StatisticsAccumulator::StatisticsAccumulator() {
  const Lanes zero{};
  x_ = y_ = z_ = resultant_ = torque_ = {zero, zero, zero + kInfinity, zero - kInfinity};
}

inline void StatisticsAccumulator::take(Sums& sums, const Lanes& values) {
  sums.sum += values;
  sums.squares += values * values;
  sums.min = values < sums.min ? values : sums.min;
  sums.max = values > sums.max ? values : sums.max;
}

/// The lanes from `count` on are zero and do not count.
inline void StatisticsAccumulator::take(Sums& sums, const Lanes& values, int count) {
  sums.sum += values;
  sums.squares += values * values;
  for (int i = 0; i < count; ++i) {
    sums.min[i] = std::min(sums.min[i], values[i]);
    sums.max[i] = std::max(sums.max[i], values[i]);
  }
}

void StatisticsAccumulator::add(const ForceSamples& samples, std::int64_t count) {
  std::int64_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Lanes x = load(&samples.x[i]);
    const Lanes y = load(&samples.y[i]);
    const Lanes z = load(&samples.z[i]);
    take(x_, x);
    take(y_, y);
    take(z_, z);
    take(resultant_, square_root(x * x + y * y + z * z));
    take(torque_, load(&samples.torque[i]));
  }
  if (const int rest = static_cast<int>(count - i); rest > 0) {
    const Lanes x = load_part(&samples.x[i], rest);
    const Lanes y = load_part(&samples.y[i], rest);
    const Lanes z = load_part(&samples.z[i], rest);
    take(x_, x, rest);
    take(y_, y, rest);
    take(z_, z, rest);
    take(resultant_, square_root(x * x + y * y + z * z), rest);
    take(torque_, load_part(&samples.torque[i], rest), rest);
  }
  count_ += count;
}

Statistics StatisticsAccumulator::statistics(const Sums& sums) const {
  if (count_ == 0) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone, kNone, kNone};
  }
  double min = sums.min[0];
  double max = sums.max[0];
  for (int i = 1; i < kLanes; ++i) {
    min = std::min(min, sums.min[i]);
    max = std::max(max, sums.max[i]);
  }
  const auto n = static_cast<double>(count_);
  return {total(sums.sum) / n, min, max, std::sqrt(total(sums.squares) / n)};
}

ForceStatistics StatisticsAccumulator::result() const {
  const Statistics torque = statistics(torque_);
  return {statistics(x_),         statistics(y_), statistics(z_),
          statistics(resultant_), torque.mean,    torque.max};
}

double largest_chip_thickness(const cutter::Cutter& cutter, const Engagement& engagement,
                              double feed_per_tooth) {
  const double steepest =
      std::clamp(0.5 * core::kPi, engagement.entry_angle, engagement.exit_angle);
  return feed_per_tooth * std::sin(steepest) *
         cutter::largest_sin_kappa(cutter, engagement.axial_depth);
}

}  // namespace millstudy::force
