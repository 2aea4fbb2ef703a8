// SPDX-License-Identifier: MIT
#include "identify/axis_map.h"

#include <gtest/gtest.h>

#include "error_text.h"
#include "identify/force_unit.h"

namespace millstudy::identify {
namespace {

TEST(AxisMap, ReadsSignsAndLeavesOutWhatWasNotMeasured) {
  const AxisMap map = parse_axis_map({"-Fy", "+ Fx", ""});
  EXPECT_EQ(map.axes[0].channel, "Fy");
  EXPECT_EQ(map.axes[0].sign, -1.0);
  EXPECT_EQ(map.axes[1].channel, "Fx");
  EXPECT_EQ(map.axes[1].sign, 1.0);
  EXPECT_FALSE(map.has_axis(2));
  EXPECT_EQ(map.to_string(), "x = -Fy, y = Fx");
}

TEST(AxisMap, RefusesAChannelForTwoAxesNamingBoth) {
  const std::string text = error_text([] { parse_axis_map({"Fx", "Fy", "-Fx"}, {"fit.toml", 7}); });
  EXPECT_EQ(text, "fit.toml:7: axes.x and axes.z both take channel Fx");
}

TEST(AxisMap, NamesEveryFault) {
  const std::string text = error_text([] { parse_axis_map({"-", "Fy", "Fy"}); });
  EXPECT_TRUE(contains(text, "axes.x = \"-\" names no channel")) << text;
  EXPECT_TRUE(contains(text, "axes.y and axes.z both take channel Fy")) << text;
}

TEST(AxisMap, NeedsAnAxis) {
  EXPECT_TRUE(contains(error_text([] { parse_axis_map({"", "  ", ""}); }), "write axes ="));
}

TEST(ForceUnit, KnowsForcesAndVoltages) {
  EXPECT_EQ(newtons_per("N"), 1.0);
  EXPECT_EQ(newtons_per("[kN]"), 1000.0);
  EXPECT_EQ(newtons_per("mN"), 1e-3);
  EXPECT_DOUBLE_EQ(*newtons_per("lbf"), 0.45359237 * 9.80665);
  EXPECT_EQ(volts_per("mV"), 1e-3);
  EXPECT_FALSE(newtons_per("MN m"));
  EXPECT_FALSE(newtons_per(""));
  EXPECT_FALSE(newtons_per("V"));
  EXPECT_FALSE(volts_per("N"));
}

}  // namespace
}  // namespace millstudy::identify
