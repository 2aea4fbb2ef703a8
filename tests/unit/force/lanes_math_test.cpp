// SPDX-License-Identifier: MIT
#include "force/lanes_math.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <vector>

namespace millstudy::force {
namespace {

constexpr long double kLongPi = 3.14159265358979323846264338327950288L;

/// Calls visit(argument, lane by lane result index) for as many arguments as there are lanes.
template <class Visit>
void by_lanes(const std::vector<double>& arguments, const Visit& visit) {
  for (std::size_t i = 0; i < arguments.size(); i += kLanes) {
    Lanes lanes{};
    const std::size_t count = std::min<std::size_t>(kLanes, arguments.size() - i);
    for (std::size_t lane = 0; lane < count; ++lane) lanes[lane] = arguments[i + lane];
    visit(lanes, static_cast<int>(count));
  }
}

/// The angle in 0 .. pi by long double.
long double exact_arc_cotangent(double t) {
  const long double angle = atan2l(1.0L, static_cast<long double>(t));
  return angle < 0.0L ? angle + kLongPi : angle;
}

TEST(LanesMath, ArcCotangentIsRightForEveryMagnitude) {
  std::vector<double> arguments = {0.0, -0.0, 1.0, -1.0, 1e300, -1e300, 5e-324, -5e-324};
  for (int i = -3000; i <= 3000; ++i) {
    const double size = std::pow(10.0, 0.1 * i);
    for (const double sign : {1.0, -1.0}) arguments.push_back(sign * size);
  }
  for (int i = -100'000; i <= 100'000; ++i) arguments.push_back(1e-4 * i);
  long double worst = 0.0L, worst_of = 0.0L;
  by_lanes(arguments, [&](const Lanes& t, int count) {
    const AngleLanes found = arc_cotangent(t);
    for (int i = 0; i < count; ++i) {
      const long double exact = exact_arc_cotangent(t[i]);
      const long double off = std::abs(static_cast<long double>(found.angle[i]) - exact);
      EXPECT_TRUE(off < 6e-16L) << t[i];
      worst = std::max(worst, off);
      const long double sine = std::abs(static_cast<long double>(found.of.sine[i]) - sinl(exact));
      const long double cosine =
          std::abs(static_cast<long double>(found.of.cosine[i]) - cosl(exact));
      EXPECT_TRUE(std::max(sine, cosine) < 4e-16L) << t[i];
      worst_of = std::max({worst_of, sine, cosine});
    }
  });
  std::cout << "arc_cotangent: " << worst << " absolute, its sine and cosine " << worst_of << "\n";
}

TEST(LanesMath, ComparesLaneByLane) {
  const Lanes a = 1.0 + kLaneIndex;
  const Lanes b = (kLanes + 1.0) - a;
  const Lanes low = smaller(a, b), high = larger(a, b);
  for (int i = 0; i < kLanes; ++i) {
    EXPECT_EQ(low[i], std::min(a[i], b[i]));
    EXPECT_EQ(high[i], std::max(a[i], b[i]));
  }
  EXPECT_TRUE(any(a > kLanes - 0.5));
  EXPECT_FALSE(any(a > kLanes * 1.0));
}

}  // namespace
}  // namespace millstudy::force
