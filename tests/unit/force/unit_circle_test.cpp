// SPDX-License-Identifier: MIT
#include "force/unit_circle.h"

#include <cmath>
#include <gtest/gtest.h>

#include "core/units.h"

namespace millstudy::force {
namespace {

void expect_circle(const UnitCircle& circle, int angular_steps, int count) {
  ASSERT_GE(circle.cosine.size(), static_cast<std::size_t>(count));
  ASSERT_GE(circle.sine.size(), static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    const double angle = core::kTurn * n / angular_steps;
    ASSERT_EQ(circle.cosine[n], std::cos(angle)) << n << " of " << angular_steps;
    ASSERT_EQ(circle.sine[n], std::sin(angle)) << n << " of " << angular_steps;
  }
}

TEST(UnitCircle, HasTheAnglesAskedForWhateverWasAskedBefore) {
  for (const int steps : {1, 7, 720, 360, 720, 65'536, 65'537, 3, 720}) {
    expect_circle(*UnitCircle::of(steps, steps), steps, steps);
    expect_circle(*UnitCircle::of(steps, steps + 8), steps, steps + 8);
    expect_circle(*UnitCircle::of(steps, steps + 100), steps, steps + 100);
  }
}

TEST(UnitCircle, IsSharedUntilAnotherIsAskedFor) {
  const auto circle = UnitCircle::of(720, 180);
  EXPECT_EQ(circle, UnitCircle::of(720, 720));
  const auto other = UnitCircle::of(360, 360);
  EXPECT_NE(circle, other);
  expect_circle(*circle, 720, 720);  // stays with those who have it
}

TEST(UnitCircle, OfManyStepsIsNoLongerThanAskedFor) {
  const auto circle = UnitCircle::of(10'000'000, 1000);
  EXPECT_EQ(circle->cosine.size(), 1000u);
  expect_circle(*circle, 10'000'000, 1000);
}

}  // namespace
}  // namespace millstudy::force
