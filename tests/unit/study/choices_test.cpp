// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/units.h"
#include "study_text.h"

namespace millstudy::study {
namespace {

using namespace testing;

TEST(Choices, AKeyThatAShapeDoesNotUseIsAFault) {
  Value root = slot_study();
  set(root, "cutter", "taper_deg", of(3.0));
  EXPECT_EQ(faults_of(root),
            "test.toml:1: cutter.taper_deg is not used by shape flat: leave it out");
  set(root, "cutter", "shape", of("ball"));
  EXPECT_EQ(faults_of(root), "");
}

TEST(Choices, AShapeMissesTheKeysItNeeds) {
  Value root = slot_study();
  set(root, "cutter", "shape", of("bull_nose"));
  EXPECT_EQ(faults_of(root), "test.toml: cutter.corner_radius_mm [mm] is missing: corner radius");
  set(root, "cutter", "corner_radius_mm", of(6.5));
  EXPECT_EQ(faults_of(root),
            "test.toml:1: cutter.corner_radius_mm must be <= half of cutter.diameter_mm (6.5 > 6 "
            "mm)");
  set(root, "cutter", "corner_radius_mm", of(1.5));
  EXPECT_EQ(resolved(root).base.cutter.corner_radius, 1.5);
}

TEST(Choices, ASweptShapeUsesWhatAnyOfThemDoes) {
  Value root = slot_study();
  set(root, "cutter", "corner_radius_mm", of(2.0));
  sweep(root, {{"cutter.shape", list("flat", "ball")}});
  EXPECT_EQ(faults_of(root),
            "test.toml:1: cutter.corner_radius_mm is not used by shape flat, ball: leave it out");
  root = slot_study();
  sweep(root, {{"cutter.shape", list("flat", "bull_nose")}});
  EXPECT_EQ(faults_of(root), "test.toml: cutter.corner_radius_mm [mm] is missing: corner radius");
  set(root, "cutter", "corner_radius_mm", of(2.0));
  EXPECT_EQ(faults_of(root), "");
}

TEST(Choices, TheModelDecidesWhichCoefficientsAreNeeded) {
  Value root = slot_study();
  remove(root, "coefficients", "Krc_N_per_mm2");
  EXPECT_EQ(faults_of(root),
            "test.toml: coefficients.Krc_N_per_mm2 [N/mm2] is missing: radial cutting-force "
            "coefficient");
  for (const char* key : {"Ktc_N_per_mm2", "Kac_N_per_mm2"}) remove(root, "coefficients", key);
  set(root, "coefficients", "model", of("orthogonal"));
  set(root, "coefficients", "shear_stress_N_per_mm2", of(613.0));
  set(root, "coefficients", "friction_angle_deg", of(19.1));
  set(root, "coefficients", "rake_deg", of(5.0));
  EXPECT_EQ(faults_of(root),
            "test.toml: coefficients.shear_angle_deg [deg] is missing: shear angle");
  set(root, "coefficients", "shear_angle_deg", of(25.0));
  EXPECT_EQ(faults_of(root), "");
  set(root, "coefficients", "Ktc_exponent", of(0.2));
  EXPECT_EQ(faults_of(root),
            "test.toml:1: coefficients.Ktc_exponent is not used by model orthogonal: leave it out");
}

TEST(Choices, ExponentsAndTheirReferenceGoTogether) {
  Value root = slot_study();
  set(root, "coefficients", "Krc_exponent", of(0.3));
  EXPECT_EQ(faults_of(root),
            "test.toml:1: coefficients.reference_chip_thickness_mm [mm] is missing: "
            "coefficients.Krc_exponent needs it");
  set(root, "coefficients", "reference_chip_thickness_mm", of(0.1));
  EXPECT_EQ(faults_of(root), "");
  remove(root, "coefficients", "Krc_exponent");
  EXPECT_EQ(faults_of(root),
            "test.toml:1: coefficients.reference_chip_thickness_mm is not used without an "
            "exponent: leave it out");
}

Value cutter_file(const char* shape) {
  return table(
      {{"shape", of(shape)}, {"diameter_mm", of(12)}, {"flutes", of(2)}, {"helix_deg", of(30)}});
}

TEST(Choices, FilesOfAnAxisMayBeOfUnlikeShapes) {
  Value root = slot_study();
  root.table().erase(root.table().begin() + 2);  // [cutter]
  sweep(root, {{"cutter.cutter_file", list("flat.toml", "nose.toml", "uneven.toml")}});
  Files files = {{"flat.toml", cutter_file("flat")},
                 {"nose.toml", cutter_file("bull_nose")},
                 {"uneven.toml", cutter_file("flat")}};
  files.at("nose.toml").table().push_back({"corner_radius_mm", of(1.0)});
  files.at("uneven.toml").table().push_back({"pitch_deg", list(170, 190)});
  const Study study = resolved(root, files);
  EXPECT_EQ(case_at(study, 0).cutter.corner_radius, 0.0);
  EXPECT_EQ(case_at(study, 1).cutter.corner_radius, 1.0);
  EXPECT_TRUE(case_at(study, 1).cutter.pitch_angles.empty());
  EXPECT_EQ(case_at(study, 2).cutter.pitch_angles.size(), 2u);
  files.at("uneven.toml").find("shape")->data = std::string("bull_nose");
  EXPECT_EQ(faults_of(root, files),
            "test.toml:1: sweep.axes: cutter.cutter_file = \"uneven.toml\" does not give "
            "cutter.corner_radius_mm, as others do");
}

Value profile(std::initializer_list<Value> points) {
  return table({{"name", of("a bulge")}, {"points_mm", {Value::Array(points), {"bulge.toml", 2}}}});
}

TEST(Profile, IsReadFromAFileThatACutterFileNames) {
  Value root = slot_study();
  root.table().erase(root.table().begin() + 2);
  root.table().push_back({"cutter_file", of("cutters/bulge.toml")});
  Value bulge = cutter_file("profile");
  bulge.table().push_back({"profile_file", of("../profiles/bulge.toml")});
  const Study study = resolved(
      root, {{"cutters/bulge.toml", bulge},
             {"cutters/../profiles/bulge.toml", profile({list(0, 0), list(2, 5), list(9, 6)})}});
  ASSERT_EQ(study.base.cutter.profile->size(), 3u);
  EXPECT_EQ((*study.base.cutter.profile)[1].z, 2.0);
  EXPECT_EQ((*study.base.cutter.profile)[1].r, 5.0);
  EXPECT_NE(study.canonical.find("cutter.profile_file = profile 0 0 2 5 9 6\n"), std::string::npos);
}

TEST(Profile, OfAnAxisIsSharedByItsPoints) {
  Value root = slot_study();
  set(root, "cutter", "shape", of("profile"));
  sweep(root, {{"cutter.profile_file", list("a.toml", "b.toml")},
               {"cut.spindle_speed_rpm", list(1000, 2000)}});
  const Study study = resolved(root, {{"a.toml", profile({list(0, 1), list(2, 5)})},
                                      {"b.toml", profile({list(0, 2), list(2, 5)})}});
  EXPECT_EQ(case_at(study, 0).cutter.profile, case_at(study, 1).cutter.profile);
  EXPECT_NE(case_at(study, 1).cutter.profile, case_at(study, 2).cutter.profile);
}

}  // namespace
}  // namespace millstudy::study
