// SPDX-License-Identifier: MIT
#include "force/lanes_math.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <vector>

namespace millstudy::force {
namespace {

constexpr long double kLongPi = 3.14159265358979323846264338327950288L;

/// The angle of (x, y), in 0 .. pi, by long double.
long double exact_angle(double x, double y) {
  const long double angle = atan2l(static_cast<long double>(y), static_cast<long double>(x));
  return angle < 0.0L ? angle + kLongPi : angle;
}

TEST(LanesMath, AngleOfAVectorIsRightForEveryMagnitude) {
  struct Vector {
    double x;
    double y;
  };
  std::vector<Vector> vectors = {{0.0, 1.0},    {-0.0, 1.0},    {1.0, 0.0},  {-1.0, 0.0},
                                 {1e300, 1e-9}, {-1e300, 1e-9}, {1.0, 1e-9}, {-1e-290, 1e-290}};
  for (int i = -290; i <= 300; ++i) {
    const double size = std::pow(10.0, i);
    for (int turn = 0; turn <= 1000; ++turn) {
      const double angle = 1e-3 * turn * core::kPi;
      vectors.push_back({size * std::cos(angle), std::abs(size * std::sin(angle))});
    }
    for (const double sign : {1.0, -1.0}) vectors.push_back({sign * size, 1.0});
  }
  long double worst = 0.0L;
  for (std::size_t i = 0; i < vectors.size(); i += kLanes) {
    Lanes x{}, y{};
    const int count = static_cast<int>(std::min<std::size_t>(kLanes, vectors.size() - i));
    for (int lane = 0; lane < count; ++lane)
      x[lane] = vectors[i + lane].x, y[lane] = vectors[i + lane].y;
    const Lanes found = angle_of(x, y);
    for (int lane = 0; lane < count; ++lane) {
      const long double exact = exact_angle(x[lane], y[lane]);
      const long double off = std::abs(static_cast<long double>(found[lane]) - exact);
      EXPECT_TRUE(off < 6e-16L) << x[lane] << " " << y[lane];
      worst = std::max(worst, off);
    }
  }
  std::cout << "angle_of: " << worst << " absolute\n";
}

TEST(LanesMath, AngleOfNoVectorIsFinite) {
  const Lanes found = angle_of(Lanes{}, Lanes{});
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_TRUE(std::isfinite(found[lane]));
}

TEST(LanesMath, SineAndCosineAreRightToRounding) {
  constexpr double kMost = 1.6;
  long double worst = 0.0L;
  for (double from = -kMost; from <= kMost; from += 1e-5) {
    const Lanes x = from + 1e-6 * kLaneIndex;
    const SineAndCosine found = sine_and_cosine(x);
    for (int lane = 0; lane < kLanes; ++lane) {
      const long double exact = x[lane];
      worst = std::max(worst, std::abs(found.sine[lane] - sinl(exact)));
      worst = std::max(worst, std::abs(found.cosine[lane] - cosl(exact)));
    }
  }
  std::cout << "sine_and_cosine: " << worst << " absolute\n";
  EXPECT_LT(worst, 4e-16L);
}

TEST(LanesMath, ComparesLaneByLane) {
  const Lanes a = 1.0 + kLaneIndex;
  const Lanes b = (kLanes + 1.0) - a;
  const Lanes high = larger(a, b);
  for (int i = 0; i < kLanes; ++i) EXPECT_EQ(high[i], std::max(a[i], b[i]));
  EXPECT_TRUE(any(a > kLanes - 0.5));
  EXPECT_FALSE(any(a > kLanes * 1.0));
}

}  // namespace
}  // namespace millstudy::force
