// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "study/share_key.h"
#include "study_text.h"

namespace millstudy::study {
namespace {

using namespace testing;

sweep::Block evaluated(const Study& study) {
  sweep::Block block(0, study.space.points(), study.columns.size(), study.outputs.traces);
  block_evaluator(study)(block);
  return block;
}

std::size_t column(const Study& study, std::string_view name) {
  const std::vector<sweep::Column>& columns = study.columns;
  const auto at = std::find_if(columns.begin(), columns.end(),
                               [&](const sweep::Column& c) { return c.name == name; });
  return static_cast<std::size_t>(at - columns.begin());
}

TEST(ForceKind, GivesTheArticlesSlot) {
  Value root = slot_study();
  root.table().push_back({"numerics", table({{"angular_steps", of(3600)}})});
  const Study study = resolved(root);
  const sweep::Block block = evaluated(study);
  ASSERT_EQ(block.status[0], sweep::Status::ok);
  EXPECT_NEAR(block.value(column(study, "force_resultant_mean"), 0), 56.6318, 5e-5);
  EXPECT_NEAR(block.value(column(study, "feed_per_tooth"), 0), 0.06, 1e-15);
  EXPECT_NEAR(block.value(column(study, "material_removal_rate"), 0), 10.44, 1e-12);
}

TEST(ForceKind, PowerIsTorqueTimesSpeed) {
  Value root = slot_study();
  sweep(root, {{"cut.spindle_speed_rpm", list(500.0, 8000.0, 20000.0)},
               {"cutter.helix_deg", list(-40.0, 0.0, 30.0)}});
  const Study study = resolved(root);
  const sweep::Block block = evaluated(study);
  for (std::int64_t i = 0; i < block.count; ++i) {
    const double omega = 2.0 * M_PI * case_at(study, i).cut.spindle_speed;
    const double torque = block.value(column(study, "torque_mean"), i);
    EXPECT_GT(torque, 0.0);
    EXPECT_NEAR(block.value(column(study, "power_mean"), i), torque * omega,
                1e-12 * torque * omega);
  }
}

TEST(Evaluate, AFailedPointIsARowWithItsReason) {
  Value root = slot_study();
  set(root, "cut", "milling", of("up"));
  sweep(root, {{"cut.radial_depth_mm", list(3.0, 12.0, 13.0)}});
  const Study study = resolved(root);
  const sweep::Block block = evaluated(study);
  EXPECT_EQ(block.status[0], sweep::Status::ok);
  EXPECT_EQ(block.status[1], sweep::Status::ok);
  EXPECT_EQ(block.status[2], sweep::Status::failed);
  EXPECT_EQ(block.failures[2], "cut.radial_depth_mm must be <= cutter.diameter_mm");
  EXPECT_TRUE(std::isnan(block.value(0, 2)));
}

TEST(Evaluate, SkipsWhatIsOutsideTheLimitsBoundsInclusive) {
  Value root = slot_study();
  sweep(root, {{"cut.feed_rate_mm_per_min", list(1740.0, 2900.0, 2901.0)}});
  root.find("sweep")->table().push_back(
      {"where",
       {Value::Array{table({{"quantity", of("feed_per_tooth_mm")}, {"max", of(0.1)}})},
        {"test.toml", 1}}});
  const Study study = resolved(root);
  const sweep::Block block = evaluated(study);
  EXPECT_EQ(block.status[0], sweep::Status::ok);
  EXPECT_EQ(block.status[1], sweep::Status::ok);
  EXPECT_EQ(block.status[2], sweep::Status::skipped);
}

TEST(Evaluate, TheOrderOfLimitsDoesNotCount) {
  Value root = slot_study();
  set(root, "cut", "milling", of("up"));
  sweep(root, {{"cut.radial_depth_mm", list(3.0, 13.0)}});  // 13 mm do not fit the cutter
  const Value immersion = table({{"quantity", of("radial_immersion")}, {"max", of(0.5)}});
  const Value depth = table({{"quantity", of("cut.radial_depth_mm")}, {"max", of(4.0)}});
  std::string canonical;
  for (const auto& limits : {Value::Array{immersion, depth}, Value::Array{depth, immersion}}) {
    Value limited = root;
    limited.find("sweep")->table().push_back({"where", {limits, {"test.toml", 1}}});
    const Study study = resolved(limited);
    EXPECT_EQ(evaluated(study).status[1], sweep::Status::skipped);
    EXPECT_TRUE(canonical.empty() || canonical == study.canonical);
    canonical = study.canonical;
  }
}

TEST(Evaluate, AnAbsurdFeedPerToothFails) {
  Value root = slot_study();
  sweep(root, {{"cut.spindle_speed_rpm", list(14.5, 14500.0)}});
  const sweep::Block block = evaluated(resolved(root));
  EXPECT_EQ(block.status[0], sweep::Status::failed);
  EXPECT_EQ(block.status[1], sweep::Status::ok);
}

/// Two settings that a key can have.
std::pair<Setting, Setting> two_settings(const Key& key) {
  switch (key.type) {
    case KeyType::choice:
      return {std::string(key.choices[0]), std::string(key.choices[1])};
    case KeyType::numbers:
      return {std::vector<double>{1.0, 2.0}, std::vector<double>{1.0, 3.0}};
    case KeyType::file:
      return {std::make_shared<const cutter::Profile>(), std::make_shared<const cutter::Profile>()};
    default:
      return {2.0, 3.0};
  }
}

TEST(ShareKey, DiffersForEveryKeyOfItsSections) {
  for (const std::span<const Key> section : {cutter_keys(), coefficient_keys()}) {
    for (const Key& key : section) {
      if (!key.field) continue;
      Case one, other;
      const auto [setting, changed] = two_settings(key);
      apply(key, setting, one);
      apply(key, changed, other);
      EXPECT_NE(share_key({section}, one, {}), share_key({section}, other, {})) << key.path;
      EXPECT_EQ(share_key({section}, one, {}), share_key({section}, Case(one), {}));
    }
  }
}

TEST(ShareKey, TellsOneHelixAngleForAllFromAListOfOne) {
  const Key& helix = *std::find_if(cutter_keys().begin(), cutter_keys().end(),
                                   [](const Key& key) { return key.path == "cutter.helix_deg"; });
  Case number, list;
  apply(helix, 30.0, number);
  apply(helix, std::vector<double>{30.0}, list);
  EXPECT_NE(share_key({cutter_keys()}, number, {}), share_key({cutter_keys()}, list, {}));
}

TEST(Evaluate, SharedGeometryGivesTheSameBitsAsItsOwn) {
  Value root = slot_study();
  set(root, "cutter", "shape", of("ball"));
  sweep(root, {{"cut.feed_rate_mm_per_min", list(600.0, 1740.0, 2900.0)},
               {"cutter.helix_deg", list(0.0, 30.0)}});
  const Study study = resolved(root);
  const sweep::Block together = evaluated(study);
  for (std::int64_t i = 0; i < together.count; ++i) {
    sweep::Block alone(i, 1, study.columns.size(), false);
    block_evaluator(study)(alone);
    for (std::size_t c = 0; c < study.columns.size(); ++c) {
      EXPECT_EQ(alone.value(c, 0), together.value(c, i)) << study.columns[c].name;
    }
  }
}

}  // namespace
}  // namespace millstudy::study
