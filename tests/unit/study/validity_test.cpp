// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "study_text.h"

namespace millstudy::study {
namespace {

using namespace testing;

/// The warnings of a study, one line each.
std::string warnings_of(const Study& study) {
  std::string text;
  for (const core::Fault& warning : study.warnings) text += to_string(warning) + '\n';
  return text;
}

TEST(Validity, IsKeptUpToItsEnds) {
  Value root = slot_study();  // 0.06 mm, 546.6 m/min
  set(root, "coefficients", "valid_feed_per_tooth_mm", list(0.06, 0.2));
  set(root, "coefficients", "valid_axial_depth_mm", list(0.1, 0.5));
  EXPECT_EQ(warnings_of(resolved(root)), "");
}

TEST(Validity, LeftIsAWarningForEachQuantity) {
  Value root = slot_study();
  set(root, "coefficients", "valid_feed_per_tooth_mm", list(0.02, 0.05));
  set(root, "coefficients", "valid_cutting_speed_m_per_min", list(100, 200));
  set(root, "coefficients", "valid_axial_depth_mm", list(1.0, 2.0));
  EXPECT_EQ(warnings_of(resolved(root)),
            "test.toml:1: feed per tooth of 0.06 mm leaves coefficients.valid_feed_per_tooth_mm = "
            "[0.02, 0.05]: the coefficients are extrapolated\n"
            "test.toml:1: cutting speed of 546.637 m/min leaves "
            "coefficients.valid_cutting_speed_m_per_min = [100, 200]: the coefficients are "
            "extrapolated\n"
            "test.toml:1: axial depth of 0.5 mm leaves coefficients.valid_axial_depth_mm = [1, 2]: "
            "the coefficients are extrapolated\n");
}

Value wide_sweep() {
  Value root = slot_study();
  set(root, "coefficients", "valid_feed_per_tooth_mm", list(0.01, 0.1));
  const auto range = [](double from, double to) {
    return table({{"from", of(from)}, {"to", of(to)}, {"count", of(300)}});
  };
  sweep(root, {{"cut.feed_rate_mm_per_min", range(600.0, 3000.0)},
               {"cut.spindle_speed_rpm", range(8000.0, 20000.0)}});
  return root;
}

TEST(Validity, IsJudgedAtTheCornersOfALargeStudy) {
  EXPECT_EQ(warnings_of(resolved(wide_sweep())),
            "test.toml:1: feed per tooth of 0.015 to 0.1875 mm leaves "
            "coefficients.valid_feed_per_tooth_mm = [0.01, 0.1]: the coefficients are "
            "extrapolated\n");
}

TEST(Validity, IsNotLeftByPointsThatAreSkipped) {
  Value root = wide_sweep();
  root.find("sweep")->table().push_back(
      {"where",
       {Value::Array{table({{"quantity", of("feed_per_tooth_mm")}, {"max", of(0.1)}})},
        {"test.toml", 1}}});
  EXPECT_EQ(warnings_of(resolved(root)), "");
}

TEST(Validity, OfAFileMayNameWorkpieceAndTool) {
  Value root = slot_study();
  Value file = section(root, "coefficients");
  root.table().erase(root.table().begin() + 3);
  root.table().push_back({"coefficients_file", of("steel.toml")});
  file.table().push_back({"workpiece", of("42CrMo4, 300 HB")});
  file.table().push_back({"tool", of("carbide, 10 deg rake")});
  file.table().push_back({"valid_axial_depth_mm", list(1.0, 2.0)});
  const Study study = resolved(root, {{"steel.toml", file}});
  EXPECT_EQ(study.warnings.size(), 1u);
  EXPECT_EQ(study.base.valid.axial_depth, (std::vector<double>{1.0, 2.0}));
}

}  // namespace
}  // namespace millstudy::study
