// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "study_text.h"

namespace millstudy::study {
namespace {

using namespace testing;

TEST(Resolve, TakesACompleteStudy) {
  const Study study = resolved(slot_study());
  EXPECT_EQ(study.name, "slot");
  EXPECT_EQ(study.kind->name, "force");
  EXPECT_EQ(study.space.points(), 1);
  EXPECT_EQ(study.base.angular_steps, 360);
  EXPECT_DOUBLE_EQ(feed_per_tooth(study.base), 0.06);
}

TEST(Resolve, ReportsEveryFault) {
  Value root = slot_study();
  set(root, "cut", "axial_depth_mm", of(-1.0));
  set(root, "cut", "speed_rpm", of(1.0));
  set(root, "cutter", "flutes", of("two"));
  EXPECT_EQ(faults_of(root),
            "test.toml:1: cutter.flutes must be a whole number, not a string\n"
            "test.toml:1: cut.axial_depth_mm = -1 mm must be > 0\n"
            "test.toml:1: cut.speed_rpm is not a key of kind force");
}

TEST(Resolve, SuggestsTheKeyThatWasMeant) {
  Value root = slot_study();
  set(root, "cut", "axial_dept_mm", of(0.5));
  EXPECT_EQ(faults_of(root),
            "test.toml:1: cut.axial_dept_mm is not a key of kind force; did you mean "
            "cut.axial_depth_mm?");
}

TEST(Resolve, RefusesContradictions) {
  Value root = slot_study();
  set(root, "cut", "feed_per_tooth_mm", of(0.06));
  set(root, "cut", "radial_depth_mm", of(3.0));
  const std::string faults = faults_of(root);
  EXPECT_NE(faults.find("cut.feed_per_tooth_mm contradicts cut.feed_rate_mm_per_min"), faults.npos);
  EXPECT_NE(faults.find("cut.radial_depth_mm contradicts cut.milling"), faults.npos);
}

TEST(Sweep, KeepsTheOrderOfTheFile) {
  Value root = slot_study();
  sweep(root, {{"cutter.helix_deg", list(10.0, 20.0)},
               {"cut.spindle_speed_rpm", list(1000.0, 2000.0, 3000.0)},
               {"cut.milling", list("slot")}});
  set(root, "cut", "radial_depth_mm", of(3.0));
  const sweep::Layout result = layout(resolved(root));
  EXPECT_EQ(result.dimensions,
            (std::vector<std::string>{"helix_deg", "spindle_speed_rpm", "milling"}));
  EXPECT_EQ(result.shape, (std::vector<std::int64_t>{2, 3, 1}));
  EXPECT_EQ(result.coordinates[0].units, "degree");
  EXPECT_EQ(result.coordinates[1].units, "min-1");
}

TEST(Sweep, RangesEndExactlyWhereTheySay) {
  Value root = slot_study();
  sweep(root,
        {{"cut.feed_rate_mm_per_min",
          table({{"from", of(600.0)}, {"to", of(3000.1)}, {"count", of(7)}})},
         {"cutter.flutes",
          table({{"from", of(1)}, {"to", of(8)}, {"count", of(4)}, {"spacing", of("log")}})}});
  const Study study = resolved(root);
  EXPECT_EQ(study.axes[0].numbers.front(), 600.0);
  EXPECT_EQ(study.axes[0].numbers.back(), 3000.1);
  EXPECT_EQ(study.axes[1].numbers, (std::vector<double>{1, 2, 4, 8}));
}

TEST(Sweep, ChecksEveryValue) {
  Value root = slot_study();
  sweep(root, {{"cut.axial_depth_mm", list(0.5, -0.5, 0.0)}});
  EXPECT_EQ(faults_of(root),
            "test.toml:1: cut.axial_depth_mm = -0.5 mm must be > 0\n"
            "test.toml:1: cut.axial_depth_mm = 0 mm must be > 0");
}

TEST(Sweep, RefusesMorePointsThanCanBe) {
  Value root = slot_study();
  const Value range = table({{"from", of(1.0)}, {"to", of(2.0)}, {"count", of(100'000)}});
  sweep(root, {{"cut.axial_depth_mm", range},
               {"cut.spindle_speed_rpm", range},
               {"cutter.diameter_mm", range}});
  EXPECT_NE(faults_of(root).find("1e+15 points"), std::string::npos) << faults_of(root);
}

TEST(StudyHash, IgnoresWhatDoesNotChangeTheResult) {
  Value plain = slot_study();
  Value renamed = slot_study();
  set(renamed, "study", "name", of("other"));
  set(renamed, "study", "description", of("words"));
  EXPECT_EQ(resolved(plain).canonical, resolved(renamed).canonical);

  Value with_default = slot_study();
  with_default.table().push_back({"numerics", table({{"angular_steps", of(360)}})});
  EXPECT_EQ(resolved(plain).canonical, resolved(with_default).canonical);

  Value changed = slot_study();
  set(changed, "cut", "axial_depth_mm", of(0.6));
  EXPECT_NE(resolved(plain).canonical, resolved(changed).canonical);
}

}  // namespace
}  // namespace millstudy::study
