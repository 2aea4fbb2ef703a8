// SPDX-License-Identifier: MIT
#include "sweep/parameter_space.h"

#include <array>
#include <gtest/gtest.h>
#include <set>

#include "core/error.h"

namespace millstudy::sweep {
namespace {

TEST(Grid, VisitsEveryCombinationOnceLastAxisFastest) {
  const ParameterSpace space(Design::grid, {3, 1, 4});
  ASSERT_EQ(space.points(), 12);
  std::set<std::array<std::int64_t, 3>> seen;
  for (std::int64_t point = 0; point < 12; ++point) {
    std::array<std::int64_t, 3> at{};
    space.indices(point, at);
    EXPECT_EQ(at[0] * 4 + at[2], point);
    EXPECT_EQ(at[1], 0);
    seen.insert(at);
  }
  EXPECT_EQ(seen.size(), 12U);
}

TEST(Zip, TakesTheIthValueOfEveryAxis) {
  const ParameterSpace space(Design::zip, {5, 5});
  ASSERT_EQ(space.points(), 5);
  std::array<std::int64_t, 2> at{};
  space.indices(3, at);
  EXPECT_EQ(at, (std::array<std::int64_t, 2>{3, 3}));
}

TEST(ParameterSpace, WithoutAxesIsOnePoint) {
  const ParameterSpace space(Design::grid, {});
  EXPECT_EQ(space.points(), 1);
  space.indices(0, {});
}

TEST(ParameterSpace, RefusesWhatCannotBeRun) {
  EXPECT_THROW(ParameterSpace(Design::zip, {3, 4}), core::InputError);
  EXPECT_THROW(ParameterSpace(Design::grid, {100'000, 100'000, 100'000}), core::InputError);
  EXPECT_THROW(ParameterSpace(Design::grid, std::vector<std::int64_t>(64, 1'000'000)),
               core::InputError);
  EXPECT_NO_THROW(ParameterSpace(Design::grid, {1000, 1000, 1000}));
}

}  // namespace
}  // namespace millstudy::sweep
