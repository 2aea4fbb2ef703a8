// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/units.h"
#include "study_text.h"

namespace millstudy::study {
namespace {

using namespace testing;

Value mode(double frequency, double damping, const char* name, double value) {
  return table(
      {{"frequency_Hz", of(frequency)}, {"damping_ratio", of(damping)}, {name, of(value)}});
}

Value lobes() {
  Value root = slot_study();
  set(root, "study", "kind", of("stability"));
  root.table().push_back({"modes", table({})});
  set(root, "modes", "x",
      list(mode(900.0, 0.01, "mass_kg", 0.04), mode(1500.0, 0.02, "stiffness_N_per_m", 2e7)));
  return root;
}

TEST(Modes, AreListsOfTables) {
  const dynamics::Machine machine = study::machine(resolved(lobes()).base);
  ASSERT_EQ(machine.x.size(), 2u);
  EXPECT_TRUE(machine.y.empty());
  EXPECT_DOUBLE_EQ(machine.x[0].mode.natural_frequency, 900.0 * 2.0 * core::kPi);
  EXPECT_DOUBLE_EQ(machine.x[0].mass, 0.04e-3);
  EXPECT_DOUBLE_EQ(machine.x[1].stiffness, 2e4);
}

TEST(Modes, CanBeSwept) {
  Value root = lobes();
  sweep(root, {{"modes.x.1.damping_ratio", list(0.02, 0.04)}});
  const Study study = resolved(root);
  EXPECT_DOUBLE_EQ(machine(case_at(study, 1)).x[1].mode.damping_ratio, 0.04);
  EXPECT_DOUBLE_EQ(machine(case_at(study, 1)).x[0].mode.damping_ratio, 0.01);
  EXPECT_EQ(layout(study).coordinates[0].name, "damping_ratio");
}

TEST(Modes, ThatCoupleHaveResidues) {
  Value root = lobes();
  set(root, "modes", "coupled",
      list(table({{"frequency_Hz", of(700.0)},
                  {"damping_ratio", of(0.03)},
                  {"residue_per_kg", list(2.0, 0.5, 0.25, 1.0)}})));
  const dynamics::Machine machine = study::machine(resolved(root).base);
  ASSERT_EQ(machine.coupled.size(), 1u);
  EXPECT_DOUBLE_EQ(machine.coupled[0].residue[1], 500.0);  // [mm/(N s2)]
  EXPECT_DOUBLE_EQ(machine.coupled[0].residue[2], 250.0);
}

TEST(Modes, OfTheStudyAreReadBeforeThoseOfItsFile) {
  Value root = lobes();
  set(root, "modes", "modes_file", of("modes.toml"));
  const Value file = table({{"x", list(mode(100.0, 0.5, "mass_kg", 1.0))},
                            {"y", list(mode(200.0, 0.5, "mass_kg", 2.0))}});
  const dynamics::Machine machine = study::machine(resolved(root, {{"modes.toml", file}}).base);
  EXPECT_DOUBLE_EQ(machine.x[0].mode.natural_frequency, 900.0 * 2.0 * core::kPi);
  ASSERT_EQ(machine.y.size(), 1u);
  EXPECT_DOUBLE_EQ(machine.y[0].mass, 2e-3);
}

}  // namespace
}  // namespace millstudy::study
