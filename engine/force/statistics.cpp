// SPDX-License-Identifier: MIT
#include "force/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "force/lanes.h"

namespace millstudy::force {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <std::size_t kParts>
double total(const std::array<double, kParts>& parts) {
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

}  // namespace

/// Sums of one quantity in registers, while a piece is taken in.
class StatisticsAccumulator::Taker {
  static_assert(kLanes <= kParts);

 public:
  explicit Taker(Sums& sums)
      : sums_(sums),
        sum_(load(sums.sum.data())),
        squares_(load(sums.squares.data())),
        min_(load(sums.min.data())),
        max_(load(sums.max.data())) {}

  ~Taker() {
    std::memcpy(sums_.sum.data(), &sum_, sizeof sum_);
    std::memcpy(sums_.squares.data(), &squares_, sizeof squares_);
    std::memcpy(sums_.min.data(), &min_, sizeof min_);
    std::memcpy(sums_.max.data(), &max_, sizeof max_);
  }

  void take(const Lanes& values) {
    sum_ += values;
    squares_ += values * values;
    min_ = values < min_ ? values : min_;
    max_ = values > max_ ? values : max_;
  }

  /// The lanes from `count` on are zero and do not count.
  void take(const Lanes& values, int count) {
    sum_ += values;
    squares_ += values * values;
    for (int i = 0; i < count; ++i) {
      min_[i] = std::min(min_[i], values[i]);
      max_[i] = std::max(max_[i], values[i]);
    }
  }

 private:
  Sums& sums_;
  Lanes sum_;
  Lanes squares_;
  Lanes min_;
  Lanes max_;
};

StatisticsAccumulator::StatisticsAccumulator() {
  for (Sums& sums : sums_) {
    sums.sum.fill(0.0);
    sums.squares.fill(0.0);
    sums.min.fill(kInfinity);
    sums.max.fill(-kInfinity);
  }
}

void StatisticsAccumulator::add(const ForceSamples& samples, std::int64_t count) {
  Taker x_taker(sums_[0]), y_taker(sums_[1]), z_taker(sums_[2]);
  Taker resultant_taker(sums_[3]), torque_taker(sums_[4]);
  Lanes cutting{};  // how many samples have a force
  std::int64_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Lanes x = load(&samples.x[i]);
    const Lanes y = load(&samples.y[i]);
    const Lanes z = load(&samples.z[i]);
    x_taker.take(x);
    y_taker.take(y);
    z_taker.take(z);
    const Lanes resultant = square_root(x * x + y * y + z * z);
    resultant_taker.take(resultant);
    cutting += resultant != 0.0 ? Lanes{} + 1.0 : Lanes{};
    torque_taker.take(load(&samples.torque[i]));
  }
  if (const int rest = static_cast<int>(count - i); rest > 0) {
    const Lanes x = load_part(&samples.x[i], rest);
    const Lanes y = load_part(&samples.y[i], rest);
    const Lanes z = load_part(&samples.z[i], rest);
    x_taker.take(x, rest);
    y_taker.take(y, rest);
    z_taker.take(z, rest);
    const Lanes resultant = square_root(x * x + y * y + z * z);
    resultant_taker.take(resultant, rest);
    cutting += resultant != 0.0 ? Lanes{} + 1.0 : Lanes{};
    torque_taker.take(load_part(&samples.torque[i], rest), rest);
  }
  for (int lane = 0; lane < kLanes; ++lane) cutting_ += static_cast<std::int64_t>(cutting[lane]);
  count_ += count;
}

Statistics StatisticsAccumulator::statistics(const Sums& sums) const {
  if (count_ == 0) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone, kNone, kNone};
  }
  double min = sums.min[0];
  double max = sums.max[0];
  for (int i = 1; i < kParts; ++i) {
    min = std::min(min, sums.min[i]);
    max = std::max(max, sums.max[i]);
  }
  const auto n = static_cast<double>(count_);
  return {total(sums.sum) / n, min, max, std::sqrt(total(sums.squares) / n)};
}

ForceStatistics StatisticsAccumulator::result() const {
  const Statistics torque = statistics(sums_[4]);
  return {statistics(sums_[0]),
          statistics(sums_[1]),
          statistics(sums_[2]),
          statistics(sums_[3]),
          torque.mean,
          torque.max,
          count_ == 0 ? std::numeric_limits<double>::quiet_NaN()
                      : static_cast<double>(cutting_) / static_cast<double>(count_)};
}

}  // namespace millstudy::force
