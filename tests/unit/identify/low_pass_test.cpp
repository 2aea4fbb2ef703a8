// SPDX-License-Identifier: MIT
#include "identify/low_pass.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/units.h"

namespace millstudy::identify {
namespace {

/// Largest value of a sine of this frequency once filtered at 300 Hz.
double gain_at(double frequency) {
  std::vector<double> sine(6000);
  for (std::size_t i = 0; i < sine.size(); ++i) {
    sine[i] = std::sin(2.0 * core::kPi * frequency * static_cast<double>(i) / 10000.0);
  }
  const std::vector<double> low = low_pass(sine, 300.0, 10000.0);
  return *std::max_element(low.begin(), low.end());
}

TEST(LowPass, PassesWhatIsBelowAndStopsWhatIsAbove) {
  for (const double below : {10.0, 100.0, 200.0, 225.0}) EXPECT_NEAR(gain_at(below), 1.0, 2e-3);
  EXPECT_NEAR(gain_at(300.0), 0.5, 2e-3);
  for (const double above : {375.0, 500.0, 1000.0, 4000.0}) EXPECT_LT(gain_at(above), 2e-3);
}

TEST(LowPass, KeepsAStraightLineWhereItIs) {
  std::vector<double> line(2000);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = 3.0 + 0.5 * static_cast<double>(i);
  const std::vector<double> low = low_pass(line, 300.0, 10000.0);
  const std::size_t cut = (low_pass_length(300.0, 10000.0) - 1) / 2;
  for (std::size_t i = 0; i < low.size(); ++i) EXPECT_NEAR(low[i], line[i + cut], 1e-9);
  EXPECT_EQ(low.size(), line.size() - 2 * cut);
}

TEST(LowPass, ThinsToEveryStep) {
  std::vector<double> noise(1500);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    noise[i] = std::sin(static_cast<double>(i * i % 977));
  }
  const std::vector<double> all = low_pass(noise, 400.0, 10000.0);
  const std::vector<double> thin = low_pass(noise, 400.0, 10000.0, 6);
  ASSERT_EQ(thin.size(), (all.size() + 5) / 6);
  for (std::size_t i = 0; i < thin.size(); ++i) EXPECT_DOUBLE_EQ(thin[i], all[6 * i]);
  EXPECT_TRUE(low_pass({noise.data(), 20}, 400.0, 10000.0).empty());
}

}  // namespace
}  // namespace millstudy::identify
