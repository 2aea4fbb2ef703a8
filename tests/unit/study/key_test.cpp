// SPDX-License-Identifier: MIT
#include "study/key.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "core/error.h"
#include "core/units.h"
#include "study/study.h"

namespace millstudy::study {
namespace {

const Key& key(std::string_view path) {
  for (const Kind* kind : kinds()) {
    if (const Key* found = kind->find_key(path)) return *found;
  }
  throw std::logic_error("no such key");
}

std::string refusal(std::string_view path, core::Value value) {
  try {
    checked_setting(key(path), value);
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

TEST(Key, SaysWhatIsWrongInOneLine) {
  const core::Place place{"slot.toml", 14};
  EXPECT_EQ(refusal("cut.feed_rate_mm_per_min", {-600.0, place}),
            "slot.toml:14: cut.feed_rate_mm_per_min = -600 mm/min must be > 0");
  EXPECT_EQ(refusal("cutter.helix_deg", {81.0, place}),
            "slot.toml:14: cutter.helix_deg = 81 deg must be <= 80");
  EXPECT_EQ(refusal("cutter.flutes", {2.5, place}),
            "slot.toml:14: cutter.flutes = 2.5 must be a whole number");
  EXPECT_EQ(refusal("cutter.flutes", {std::string("two"), place}),
            "slot.toml:14: cutter.flutes must be a whole number, not a string");
  EXPECT_EQ(refusal("cutter.shape", {std::string("cube"), place}),
            "slot.toml:14: cutter.shape = \"cube\" must be one of flat, ball");
  EXPECT_EQ(refusal("cut.axial_depth_mm", {std::nan(""), place}),
            "slot.toml:14: cut.axial_depth_mm = nan mm must be a finite number");
  EXPECT_EQ(refusal("cut.axial_depth_mm", {0.5, place}), "");
}

TEST(Key, ReadsBackWhatItSets) {
  for (const Kind* kind : kinds()) {
    for (const std::span<const Key> section : kind->sections) {
      for (const Key& key : section) {
        if (!key.numeric() || !key.field) continue;
        Case target;
        const double value =
            std::max(key.range.low, 1.0) + (key.type == KeyType::integer ? 4 : 0.5);
        apply(key, value, target);
        ASSERT_TRUE(read(key, target).has_value()) << key.path;
        EXPECT_NEAR(*read(key, target), value, 1e-15 * std::abs(value)) << key.path;
      }
    }
  }
}

TEST(Key, ConvertsToNativeUnits) {
  Case target;
  apply(key("cut.spindle_speed_rpm"), 14500.0, target);
  apply(key("cut.feed_rate_mm_per_min"), 1740.0, target);
  apply(key("cutter.helix_deg"), 30.0, target);
  apply(key("path.tolerance_percent"), 1.0, target);
  EXPECT_EQ(target.cut.spindle_speed, 14500.0 / 60.0);
  EXPECT_EQ(target.cut.feed_rate, 29.0);
  EXPECT_DOUBLE_EQ(target.cutter.helix_angle, core::kPi / 6);
  EXPECT_EQ(target.path.interpolation.tolerance, 0.01);
}

TEST(Key, ChoicesNameTheEnumerationInItsOrder) {
  Case target;
  apply(key("path.method"), std::string("uniform_parameter"), target);
  EXPECT_EQ(target.path.interpolation.method, path::Method::uniform_parameter);
  apply(key("path.method"), std::string("newton"), target);
  EXPECT_EQ(target.path.interpolation.method, path::Method::newton);
  apply(key("cutter.shape"), std::string("ball"), target);
  EXPECT_EQ(target.cutter.shape, cutter::Shape::ball);
  apply(key("cut.milling"), std::string("down"), target);
  EXPECT_EQ(target.cut.milling, Milling::down);
  apply(key("numerics.rule"), std::string("discs"), target);
  EXPECT_EQ(target.edge_rule.rule, force::Rule::discs);
}

TEST(Key, IsListedOnceInEachKind) {
  for (const Kind* kind : kinds()) {
    const std::vector<std::string_view> paths = key_paths(*kind);
    EXPECT_EQ(std::set<std::string_view>(paths.begin(), paths.end()).size(), paths.size());
  }
}

}  // namespace
}  // namespace millstudy::study
