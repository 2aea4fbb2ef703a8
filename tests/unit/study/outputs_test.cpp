// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "study/rows.h"
#include "study_text.h"

namespace millstudy::study {
namespace {

using namespace testing;

std::size_t column(const std::vector<sweep::Column>& columns, std::string_view name) {
  const auto at = std::find_if(columns.begin(), columns.end(),
                               [&](const sweep::Column& c) { return c.name == name; });
  return static_cast<std::size_t>(at - columns.begin());
}

Value with_output(Value root, std::initializer_list<std::pair<std::string, Value>> members) {
  root.table().push_back({"output", table(members)});
  return root;
}

TEST(Outputs, AreNotThereUnlessAskedFor) {
  const Study study = resolved(slot_study());
  EXPECT_EQ(study.columns.size(), 25u);
  EXPECT_EQ(study.columns[24].name, "specific_energy");
  EXPECT_EQ(layout(study).columns.size(), 25u);
}

TEST(Outputs, HaveTheHarmonicsOfForcesAndTorque) {
  const Study study = resolved(with_output(slot_study(), {{"harmonics", of(3)}}));
  ASSERT_EQ(study.columns.size(), 25u + 12u);
  EXPECT_EQ(study.columns[25].name, "force_x_harmonic_1");
  EXPECT_EQ(study.columns[25].long_name, "amplitude of force x, tooth-passing harmonic 1");
  EXPECT_EQ(study.columns[36].name, "torque_harmonic_3");
  EXPECT_EQ(study.columns[36].units, "N m");
}

TEST(Outputs, HaveColumnsForTheMostFlutesOfAnyPoint) {
  Value root = with_output(slot_study(), {{"per_flute", of(true)}});
  EXPECT_EQ(resolved(root).outputs.flutes, 2);
  sweep(root, {{"cutter.flutes", list(1, 3, 2)}});
  const Study study = resolved(root);
  EXPECT_EQ(study.outputs.flutes, 3);
  sweep::Block block(0, 3, study.columns.size(), false);
  block_evaluator(study)(block);
  const std::size_t third = column(study.columns, "flute_3_load_share");
  ASSERT_LT(third, study.columns.size());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(block.status[i], sweep::Status::ok) << block.failures[i];
  EXPECT_TRUE(std::isnan(block.value(third, 0)));
  EXPECT_FALSE(std::isnan(block.value(third, 1)));
  EXPECT_TRUE(std::isnan(block.value(third, 2)));
}

TEST(Outputs, HaveABendingMomentWhereTheStickOutIsGiven) {
  Value root = slot_study();
  set(root, "cutter", "stick_out_mm", of(40.0));
  const Study study = resolved(root);
  EXPECT_TRUE(study.outputs.bending_moment);
  EXPECT_EQ(study.base.stick_out, 40.0);
  EXPECT_LT(column(study.columns, "bending_moment_max"), study.columns.size());
}

TEST(Outputs, EnergyAndPowerFollowFromTheTorque) {
  const Study study = resolved(slot_study());
  sweep::Block block(0, 1, study.columns.size(), false);
  block_evaluator(study)(block);
  const auto value = [&](std::string_view name) {
    return block.value(column(study.columns, name), 0);
  };
  const double omega = 2.0 * M_PI * 14500.0 / 60.0;
  EXPECT_NEAR(value("power_max"), omega * value("torque_max"), 1e-9);
  EXPECT_NEAR(value("specific_energy"), value("power_mean") / (0.5 * 12.0 * 29.0), 1e-12);
}

TEST(ForceRow, HasEveryFigureInItsColumn) {
  Case point = resolved(slot_study()).base;
  point.stick_out = 40.0;
  const Outputs outputs{.harmonics = 2, .flutes = 3, .bending_moment = true};
  const std::vector<sweep::Column> columns = force_columns(outputs);
  force::ForceFigures figures;
  for (std::vector<double>& amplitudes : figures.harmonics) amplitudes.resize(outputs.harmonics);
  figures.flutes.resize(point.cutter.flutes);
  figures.statistics.cutting_fraction = 0.25;
  figures.bending_moment_max = 3000.0;
  figures.harmonics[1][0] = 7.0;
  figures.harmonics[3][1] = 500.0;
  figures.flutes[1] = {0.06, 0.5};
  std::vector<double> row(columns.size(), -1.0);
  fill_force_row(point, outputs, figures, 100.0, row);
  const auto value = [&](std::string_view name) { return row.at(column(columns, name)); };
  EXPECT_EQ(value("cutting_time_fraction"), 0.25);
  EXPECT_EQ(value("bending_moment_max"), 3.0);
  EXPECT_EQ(value("force_y_harmonic_1"), 7.0);
  EXPECT_EQ(value("torque_harmonic_2"), 0.5);
  EXPECT_EQ(value("flute_2_chip_thickness_max"), 0.06);
  EXPECT_EQ(value("flute_2_load_share"), 0.5);
  EXPECT_TRUE(std::isnan(value("flute_3_load_share")));
  EXPECT_EQ(std::count(row.begin(), row.end(), -1.0), 0);
}

}  // namespace
}  // namespace millstudy::study
