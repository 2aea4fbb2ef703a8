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
            "slot.toml:14: cutter.shape = \"cube\" must be one of flat, ball, bull_nose, "
            "taper, general, profile");
  EXPECT_EQ(refusal("cut.axial_depth_mm", {std::nan(""), place}),
            "slot.toml:14: cut.axial_depth_mm = nan mm must be a finite number");
  EXPECT_EQ(refusal("cut.axial_depth_mm", {0.5, place}), "");
}

TEST(Key, NamesTheNumberOfAListThatIsWrong) {
  const core::Place place{"slot.toml", 14};
  const auto list = [&](std::initializer_list<core::Value> items) {
    return core::Value{core::Value::Array(items), place};
  };
  const core::Value number{90.0, {"slot.toml", 15}};
  EXPECT_EQ(refusal("cutter.pitch_deg", list({number, number})), "");
  EXPECT_EQ(refusal("cutter.helix_deg", list({number})),
            "slot.toml:15: cutter.helix_deg[0] = 90 deg must be <= 80");
  EXPECT_EQ(refusal("cutter.pitch_deg", list({number, {-1.0, place}, {true, place}})),
            "slot.toml:14: cutter.pitch_deg[1] = -1 deg must be > 0\n"
            "slot.toml:14: cutter.pitch_deg[2] must be a number, not true or false");
  EXPECT_EQ(refusal("cutter.pitch_deg", list({})),
            "slot.toml:14: cutter.pitch_deg must have at least 1 number");
  EXPECT_EQ(refusal("cutter.pitch_deg", number),
            "slot.toml:15: cutter.pitch_deg must be a list of numbers, not a number");
  EXPECT_EQ(refusal("cutter.helix_deg", {std::string("steep"), place}),
            "slot.toml:14: cutter.helix_deg must be a number or a list of numbers, not a string");
  EXPECT_EQ(refusal("coefficients.valid_axial_depth_mm", list({number})),
            "slot.toml:14: coefficients.valid_axial_depth_mm must have 2 numbers, not 1");
  EXPECT_EQ(refusal("cutter.pitch_deg", {core::Value::Array(1001, core::Value{0.1, place}), place}),
            "slot.toml:14: cutter.pitch_deg has 1001 numbers, more than 1000");
  EXPECT_EQ(refusal("coefficients.Ktc_polynomial", list({number, number, number, number, number})),
            "slot.toml:14: coefficients.Ktc_polynomial has 5 numbers, more than 4");
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

TEST(Key, ConvertsEveryNumberOfAList) {
  Case target;
  apply(key("coefficients.valid_cutting_speed_m_per_min"), std::vector<double>{60.0, 120.0},
        target);
  EXPECT_EQ(target.valid.cutting_speed, (std::vector<double>{1000.0, 2000.0}));
  apply(key("coefficients.shear_stress_per_rake_N_per_mm2_per_deg"), 2.0, target);
  EXPECT_DOUBLE_EQ(target.law.orthogonal.shear_stress.per_rake, 360.0 / core::kPi);
}

TEST(Key, AFullTurnIsOneToRounding) {
  Case target;
  apply(key("cutter.pitch_deg"), std::vector<double>{90.0, 90.0, 90.0, 90.0}, target);
  EXPECT_EQ(target.cutter.pitch_angles, std::vector<double>(4, core::kPi / 2));
  apply(key("cutter.pitch_deg"), std::vector<double>{119.9999999, 120.0, 120.0000005}, target);
  double sum = 0.0;
  for (const double angle : target.cutter.pitch_angles) sum += angle;
  EXPECT_DOUBLE_EQ(sum, 2.0 * core::kPi);
  apply(key("cutter.pitch_deg"), std::vector<double>{120.0, 120.0}, target);
  EXPECT_DOUBLE_EQ(target.cutter.pitch_angles[0], core::kPi * 2 / 3)
      << "no full turn stays as it is";
}

TEST(Key, TheHelixIsOneAngleOrOneForEachFlute) {
  const Key& helix = key("cutter.helix_deg");
  Case target;
  apply(helix, std::vector<double>{30.0, 45.0}, target);
  EXPECT_DOUBLE_EQ(target.cutter.helix_angle, core::kPi / 6);
  ASSERT_EQ(target.cutter.helix_angles.size(), 2u);
  EXPECT_DOUBLE_EQ(target.cutter.helix_angles[1], core::kPi / 4);
  EXPECT_FALSE(read(helix, target).has_value());
  apply(helix, 45.0, target);
  EXPECT_TRUE(target.cutter.helix_angles.empty());
  EXPECT_DOUBLE_EQ(*read(helix, target), 45.0);
}

TEST(Key, WhatAPointDoesNotGiveIsAsInAFreshCase) {
  Case target;
  for (const std::span<const Key> section : {cutter_keys(), coefficient_keys()}) {
    for (const Key& key : section) {
      if (!key.field || key.type != KeyType::numbers) continue;
      apply(key, std::vector<double>{1.0, 2.0}, target);
      apply(key, Setting(), target);
    }
  }
  apply(key("cutter.flute_length_mm"), 3.0, target);
  apply(key("cutter.flute_length_mm"), Setting(), target);
  apply(key("cutter.helix_deg"), std::vector<double>{1.0, 2.0}, target);
  apply(key("cutter.helix_deg"), Setting(), target);
  EXPECT_TRUE(target.cutter.pitch_angles.empty());
  EXPECT_TRUE(target.cutter.helix_angles.empty());
  EXPECT_FALSE(target.cutter.flute_length.has_value());
  EXPECT_TRUE(target.law.height.table[5].empty());
}

TEST(Key, ChoicesNameTheEnumerationInItsOrder) {
  Case target;
  apply(key("path.method"), std::string("uniform_parameter"), target);
  EXPECT_EQ(target.path.interpolation.method, path::Method::uniform_parameter);
  apply(key("path.method"), std::string("newton"), target);
  EXPECT_EQ(target.path.interpolation.method, path::Method::newton);
  apply(key("cutter.shape"), std::string("ball"), target);
  EXPECT_EQ(target.cutter.shape, cutter::Shape::ball);
  apply(key("cutter.shape"), std::string("profile"), target);
  EXPECT_EQ(target.cutter.shape, cutter::Shape::profile);
  apply(key("cutter.lead"), std::string("constant_helix"), target);
  EXPECT_EQ(target.cutter.lead, cutter::Lead::constant_helix);
  apply(key("cutter.edge_measure"), std::string("edge_length"), target);
  EXPECT_EQ(target.cutter.edge_measure, cutter::EdgeMeasure::edge_length);
  apply(key("coefficients.model"), std::string("orthogonal"), target);
  EXPECT_EQ(target.law.model, CoefficientModel::orthogonal);
  apply(key("cut.stock"), std::string("both"), target);
  EXPECT_EQ(target.cut.stock, process::Stock::both);
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
