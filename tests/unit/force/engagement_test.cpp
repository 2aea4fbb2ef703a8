// SPDX-License-Identifier: MIT
#include "force/engagement.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "core/error.h"

namespace millstudy::force {
namespace {

TEST(Engagement, OfSlotUpAndDownMilling) {
  EXPECT_EQ(slot(2.0).entry_angle, 0.0);
  EXPECT_EQ(slot(2.0).exit_angle, core::kPi);
  EXPECT_EQ(up_milling(6.0, 3.0, 2.0).entry_angle, 0.0);
  EXPECT_NEAR(up_milling(6.0, 3.0, 2.0).exit_angle, core::kPi / 3.0, 1e-15);
  EXPECT_NEAR(down_milling(6.0, 3.0, 2.0).entry_angle, core::kPi * 2.0 / 3.0, 1e-15);
  EXPECT_EQ(down_milling(6.0, 3.0, 2.0).exit_angle, core::kPi);
  EXPECT_EQ(up_milling(6.0, 3.0, 2.0).axial_depth, 2.0);
}

TEST(Engagement, FullRadialDepthIsASlotBothWays) {
  EXPECT_EQ(up_milling(6.0, 12.0, 1.0).exit_angle, core::kPi);
  EXPECT_EQ(down_milling(6.0, 12.0, 1.0).entry_angle, 0.0);
}

TEST(Engagement, KeepsItsDigitsAtSmallRadialDepth) {
  // acos(1 - x) = sqrt(2 x) (1 + x / 12 + ...)
  const double x = 1e-10;
  EXPECT_NEAR(up_milling(1.0, x, 1.0).exit_angle / std::sqrt(2.0 * x), 1.0 + x / 12.0, 1e-15);
}

template <class Function>
std::string message(const Function& function) {
  try {
    function();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Engagement, OutOfRangeIsRefusedByNameValueUnitAndLimit) {
  const cutter::Cutter cutter{cutter::Shape::flat, 12.0, 2, core::rad_from_deg(45.0)};
  const auto of = [&](const Engagement& engagement) {
    return message([&] { check(cutter, engagement); });
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(of(slot(20.0)), "");
  EXPECT_NE(of({1.0, 1.0, 1.0}).find("0 <= entry < exit <= 180"), std::string::npos);
  EXPECT_NE(of({-0.1, 1.0, 1.0}).find("entry_angle = -5.7"), std::string::npos);
  EXPECT_NE(of({0.0, 4.0, 1.0}).find("exit_angle = 229.18"), std::string::npos);
  EXPECT_NE(of({kNaN, 1.0, 1.0}), "");
  EXPECT_NE(of(slot(0.0)).find("axial_depth = 0.000000 mm must be > 0"), std::string::npos);
  EXPECT_NE(of(slot(kNaN)).find("axial_depth"), std::string::npos);
  EXPECT_NE(of(slot(1e9)).find("1000 turns"), std::string::npos);
  EXPECT_NEAR(largest_axial_depth(cutter), 1000.0 * core::kPi * 12.0, 1e-9);
  EXPECT_EQ(of(slot(largest_axial_depth(cutter))), "");
  EXPECT_NE(of(slot(std::nextafter(largest_axial_depth(cutter), 1e9))).find("1000 turns"),
            std::string::npos);
  EXPECT_NE(message([] { up_milling(6.0, 12.1, 1.0); }).find("radial_depth = 12.1"),
            std::string::npos);
  EXPECT_NE(message([] { down_milling(6.0, 0.0, 1.0); }).find("must be > 0"), std::string::npos);
  EXPECT_NE(message([] { check(EdgeRule{Rule::discs, 0}); }).find("discs = 0"), std::string::npos);
}

TEST(LargestAxialDepth, IsInfiniteWithoutHelixAndTheSameForBothHands) {
  const auto of = [](double helix_angle) {
    return largest_axial_depth({cutter::Shape::ball, 12.0, 2, helix_angle});
  };
  EXPECT_EQ(of(0.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(of(-0.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(of(-0.5), of(0.5));
}

}  // namespace
}  // namespace millstudy::force
