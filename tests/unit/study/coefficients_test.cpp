// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/units.h"
#include "study/rules.h"
#include "study_text.h"

namespace millstudy::study {
namespace {

using namespace testing;

TEST(Coefficients, AreTimesTheirWearFactors) {
  Value root = slot_study();
  set(root, "coefficients", "cutting_scale", of(1.5));
  set(root, "coefficients", "edge_scale", of(2.0));
  const force::Coefficients k = scaled_coefficients(resolved(root).base);
  EXPECT_DOUBLE_EQ(k.Ktc, 1.5 * 2172.0);
  EXPECT_DOUBLE_EQ(k.Krc, 1.5 * 850.0);
  EXPECT_DOUBLE_EQ(k.Kac, 1.5 * 726.0);
  EXPECT_DOUBLE_EQ(k.Kte, 2.0 * 17.3);
  EXPECT_DOUBLE_EQ(k.Kre, 2.0 * 7.8);
  EXPECT_DOUBLE_EQ(k.Kae, 2.0 * 6.7);
}

TEST(Coefficients, DoNotVaryUnlessSaid) {
  const force::Variation constant = variation(resolved(slot_study()).base);
  EXPECT_EQ(constant.size_exponent, (std::array<double, 3>{}));
  EXPECT_EQ(constant.height, nullptr);
  EXPECT_FALSE(constant.orthogonal.has_value());
}

TEST(Coefficients, SizeEffectHasItsExponentsAndReference) {
  Value root = slot_study();
  set(root, "coefficients", "Ktc_exponent", of(0.2));
  set(root, "coefficients", "Kac_exponent", of(0.4));
  set(root, "coefficients", "reference_chip_thickness_mm", of(0.05));
  const force::Variation varied = variation(resolved(root).base);
  EXPECT_EQ(varied.size_exponent, (std::array<double, 3>{0.2, 0.0, 0.4}));
  EXPECT_EQ(varied.reference_chip_thickness, 0.05);
}

TEST(Coefficients, HeightTablesAndPolynomials) {
  Value root = slot_study();
  set(root, "coefficients", "heights_mm", list(0.0, 2.0));
  set(root, "coefficients", "Krc_table", list(1.0, 0.8));
  set(root, "coefficients", "Kae_polynomial", list(0.1, -0.02));
  const force::Variation varied = variation(resolved(root).base);
  ASSERT_NE(varied.height, nullptr);
  EXPECT_EQ(varied.height->heights, (std::vector<double>{0.0, 2.0}));
  EXPECT_TRUE(varied.height->table[0].empty());
  EXPECT_EQ(varied.height->table[1], (std::vector<double>{1.0, 0.8}));
  EXPECT_EQ(varied.height->polynomial[5], (std::vector<double>{0.1, -0.02}));
}

TEST(Coefficients, HeightsAscendAndEveryTableHasOneFactorForEach) {
  Value root = slot_study();
  set(root, "coefficients", "Krc_table", list(1.0, 0.8));
  EXPECT_EQ(
      faults_of(root),
      "test.toml:1: coefficients.heights_mm [mm] is missing: coefficients.Krc_table needs it");
  set(root, "coefficients", "heights_mm", list(0.0, 2.0, 2.0));
  EXPECT_EQ(faults_of(root),
            "test.toml:1: coefficients.heights_mm must ascend\n"
            "test.toml:1: coefficients.Krc_table must have one factor for each of "
            "coefficients.heights_mm (2 for 3 heights)");
  remove(root, "coefficients", "Krc_table");
  EXPECT_EQ(faults_of(root),
            "test.toml:1: coefficients.heights_mm is not used without a table: leave it out");
}

TEST(Coefficients, ASweptTableOfTheWrongLengthFailsItsPoints) {
  Value root = slot_study();
  set(root, "coefficients", "heights_mm", list(0.0, 2.0));
  sweep(root, {{"coefficients.Ktc_table", list(list(1.0, 0.8), list(1.0, 0.8, 0.7))}});
  const Study study = resolved(root);
  EXPECT_NO_THROW(check_point_coefficients(case_at(study, 0)));
  EXPECT_THROW(check_point_coefficients(case_at(study, 1)), core::CaseError);
}

TEST(Coefficients, OfOrthogonalTestsAreFactorsOfWhatTheseGive) {
  Value root = slot_study();
  for (const char* key : {"Ktc_N_per_mm2", "Krc_N_per_mm2", "Kac_N_per_mm2"}) {
    remove(root, "coefficients", key);
  }
  for (const auto& [key, value] : {std::pair{"shear_stress_N_per_mm2", 613.0},
                                   {"shear_angle_deg", 25.0},
                                   {"friction_angle_deg", 19.1},
                                   {"rake_deg", 5.0},
                                   {"shear_angle_per_rake", 0.36},
                                   {"friction_angle_per_chip_deg_per_mm", 10.0},
                                   {"cutting_scale", 1.2}}) {
    set(root, "coefficients", key, of(value));
  }
  set(root, "coefficients", "model", of("orthogonal"));
  const Case base = resolved(root).base;
  const force::Variation varied = variation(base);
  ASSERT_TRUE(varied.orthogonal.has_value());
  EXPECT_EQ(varied.orthogonal->shear_stress.constant, 613.0);
  EXPECT_DOUBLE_EQ(varied.orthogonal->shear_angle.constant, core::rad_from_deg(25.0));
  EXPECT_DOUBLE_EQ(varied.orthogonal->shear_angle.per_rake, 0.36);
  EXPECT_DOUBLE_EQ(varied.orthogonal->friction_angle.per_chip, core::rad_from_deg(10.0));
  EXPECT_DOUBLE_EQ(varied.orthogonal->rake_angle, core::rad_from_deg(5.0));
  EXPECT_EQ(scaled_coefficients(base).Ktc, 1.2);
  EXPECT_EQ(scaled_coefficients(base).Kac, 1.2);
  EXPECT_EQ(scaled_coefficients(base).Kte, 17.3);
}

}  // namespace
}  // namespace millstudy::study
