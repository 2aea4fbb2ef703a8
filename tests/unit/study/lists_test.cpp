// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/units.h"
#include "study_text.h"

namespace millstudy::study {
namespace {

using namespace testing;

Value four_flutes() {
  Value root = slot_study();
  set(root, "cutter", "flutes", of(4));
  return root;
}

TEST(Lists, TakeOneNumberForEachFlute) {
  Value root = four_flutes();
  set(root, "cutter", "pitch_deg", list(80.0, 100.0, 80.0, 100.0));
  set(root, "cutter", "helix_deg", list(30, 35, 30, 35));
  const Study study = resolved(root);
  EXPECT_EQ(study.base.cutter.pitch_angles.size(), 4u);
  EXPECT_DOUBLE_EQ(study.base.cutter.helix_angles[3], core::rad_from_deg(35.0));
}

TEST(Lists, OfTheWrongLengthOrSumAreFaults) {
  Value root = four_flutes();
  set(root, "cutter", "pitch_deg", list(120.0, 120.0, 121.0));
  set(root, "cutter", "helix_deg", list(30.0, -35.0, 30.0, 35.0));
  EXPECT_EQ(faults_of(root),
            "test.toml:1: cutter.pitch_deg must have one angle for each flute (3 for 4 flutes)\n"
            "test.toml:1: cutter.pitch_deg must add up to 360 deg (361)\n"
            "test.toml:1: cutter.helix_deg must be of one hand");
}

TEST(Lists, OfTheWrongLengthAreFaultsUnlessOneOfTheTwoIsSwept) {
  Value root = four_flutes();
  set(root, "cutter", "pitch_deg", list(120.0, 120.0, 120.0));
  Value other = root;
  sweep(other, {{"cutter.runout_offset_mm", list(0.0, 0.01)}});
  EXPECT_EQ(faults_of(other),
            "test.toml:1: cutter.pitch_deg must have one angle for each flute (3 for 4 flutes)");
  sweep(root, {{"cutter.flutes", list(3, 4)}});
  EXPECT_EQ(faults_of(root), "");
}

TEST(Lists, AsAnAxisAreLabelledByTheirNumbers) {
  Value root = four_flutes();
  sweep(root, {{"cutter.pitch_deg", list(list(90, 90, 90, 90), list(80, 100, 80, 100))},
               {"cutter.helix_deg", list(list(30, 30, 30, 30), list(30.5, 35, 30.5, 35))}});
  const Study study = resolved(root);
  const sweep::Layout result = layout(study);
  EXPECT_EQ(std::get<std::vector<std::string>>(result.coordinates[0].values),
            (std::vector<std::string>{"90 90 90 90", "80 100 80 100"}));
  EXPECT_EQ(result.shape, (std::vector<std::int64_t>{2, 2}));
  EXPECT_DOUBLE_EQ(case_at(study, 3).cutter.pitch_angles[0], core::rad_from_deg(80.0));
  EXPECT_DOUBLE_EQ(case_at(study, 3).cutter.helix_angle, core::rad_from_deg(30.5));
  EXPECT_DOUBLE_EQ(case_at(study, 0).cutter.pitch_angles[0], core::kPi / 2);
}

TEST(Lists, AnAxisOfHelixAnglesHasNumbersOrLists) {
  Value root = four_flutes();
  sweep(root, {{"cutter.helix_deg", list(30.0, 40.0)}});
  EXPECT_EQ(std::get<std::vector<double>>(layout(resolved(root)).coordinates[0].values),
            (std::vector<double>{30.0, 40.0}));
  root = four_flutes();
  sweep(root, {{"cutter.helix_deg", list(of(30.0), list(30.0, 30.0, 30.0, 30.0))}});
  EXPECT_EQ(faults_of(root),
            "test.toml:1: sweep.axes: cutter.helix_deg mixes numbers and lists: give one or the "
            "other");
}

TEST(Lists, AnAxisOfOneListIsAFault) {
  Value root = four_flutes();
  sweep(root, {{"cutter.pitch_deg", list(90, 90, 90, 90)}});
  EXPECT_EQ(faults_of(root),
            "test.toml:1: sweep.axes: cutter.pitch_deg must be a list of lists: [[...], [...]]");
}

TEST(Lists, CannotBeLimited) {
  Value root = four_flutes();
  sweep(root, {{"cutter.helix_deg", list(list(30, 30, 30, 30), list(30, 35, 30, 35))}});
  root.find("sweep")->table().push_back(
      {"where",
       {Value::Array{table({{"quantity", of("cutter.helix_deg")}, {"max", of(40)}})},
        {"test.toml", 1}}});
  EXPECT_EQ(faults_of(root),
            "test.toml:1: sweep.where: quantity = \"cutter.helix_deg\" is a list in this study");
}

TEST(Lists, AreInTheHashWithEveryNumber) {
  Value root = four_flutes();
  set(root, "cutter", "pitch_deg", list(80.0, 100.0, 80.0, 100.0));
  Value other = root;
  set(other, "cutter", "pitch_deg", list(80.0, 100.0, 81.0, 99.0));
  EXPECT_NE(resolved(root).canonical, resolved(other).canonical);
  EXPECT_NE(resolved(root).canonical.find("cutter.pitch_deg = 80 100 80 100\n"), std::string::npos);
}

}  // namespace
}  // namespace millstudy::study
