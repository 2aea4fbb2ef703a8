// SPDX-License-Identifier: MIT
#include "identify/mode_fit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "core/error.h"
#include "dynamics/state_space.h"

namespace millstudy::identify {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

dynamics::MeasuredResponse measured(const std::vector<dynamics::AxisMode>& modes,
                                    double noise = 0.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  dynamics::MeasuredResponse response;
  dynamics::Machine machine;
  machine.x = modes;
  double largest = 0.0;
  for (int hertz = 20; hertz <= 5000; hertz += 4) {
    response.omega.push_back(kTurn * hertz);
    response.compliance.push_back(frequency_response(machine, kTurn * hertz)(0, 0));
    largest = std::max(largest, std::abs(response.compliance.back()));
  }
  for (std::complex<double>& value : response.compliance) {
    value += noise * largest * std::complex<double>(normal(random), normal(random));
  }
  return response;
}

/// One to four modes with frequencies at least 15 % apart.
std::vector<dynamics::AxisMode> random_modes(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform;
  std::vector<dynamics::AxisMode> modes(1 + random() % 4);
  double hertz = 200.0;
  for (dynamics::AxisMode& mode : modes) {
    hertz *= 1.15 + 0.8 * uniform(random);
    mode = {{kTurn * hertz, 0.01 + 0.04 * uniform(random)}, 0.0, 5e3 + 3e4 * uniform(random)};
  }
  return modes;
}

TEST(ModeFit, FindsTheModesAgain) {
  std::mt19937 random(7);
  double worst = 0.0;
  for (int i = 0; i < 60; ++i) {
    const std::vector<dynamics::AxisMode> truth = random_modes(random);
    const ModeFit fit = fit_modes(measured(truth));
    ASSERT_EQ(fit.modes.size(), truth.size()) << i << ": " << fit.unexplained;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const dynamics::AxisMode &a = fit.modes[k], &b = truth[k];
      worst = std::max({worst, std::abs(a.mode.natural_frequency / b.mode.natural_frequency - 1.0),
                        std::abs(a.mode.damping_ratio / b.mode.damping_ratio - 1.0),
                        std::abs(a.stiffness / b.stiffness - 1.0)});
    }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1e-6);
}

TEST(ModeFit, OfNoisyResponsesIsCloserThanTheNoise) {
  std::mt19937 random(8);
  double frequency = 0.0, damping = 0.0;
  for (int i = 0; i < 20; ++i) {
    std::vector<dynamics::AxisMode> truth = random_modes(random);
    truth.resize(1);
    const ModeFit fit = fit_modes(measured(truth, 0.01, 100 + i));
    ASSERT_EQ(fit.modes.size(), 1u) << i;
    frequency = std::max(
        frequency,
        std::abs(fit.modes[0].mode.natural_frequency / truth[0].mode.natural_frequency - 1.0));
    damping = std::max(
        damping, std::abs(fit.modes[0].mode.damping_ratio / truth[0].mode.damping_ratio - 1.0));
  }
  RecordProperty("frequency", std::to_string(frequency));
  RecordProperty("damping", std::to_string(damping));
  EXPECT_LT(frequency, 1e-3);
  EXPECT_LT(damping, 0.03);
}

TEST(ModeFit, StandsForModesBeyondTheBandByOne) {
  const std::vector<dynamics::AxisMode> truth = {{{kTurn * 700.0, 0.03}, 0.0, 1e4},
                                                 {{kTurn * 8000.0, 0.02}, 0.0, 2e4}};
  const ModeFit fit = fit_modes(measured(truth));
  ASSERT_EQ(fit.modes.size(), 2u);
  EXPECT_NEAR(fit.modes[0].stiffness / 1e4, 1.0, 1e-4);
  EXPECT_LT(fit.unexplained, 1e-4);
}

TEST(ModeFit, IsTheSameInAnyUnit) {
  dynamics::MeasuredResponse response =
      measured({{{kTurn * 700.0, 0.03}, 0.0, 1e4}, {{kTurn * 1500.0, 0.02}, 0.0, 3e4}});
  const ModeFit fit = fit_modes(response);
  for (std::complex<double>& value : response.compliance) value *= 0.125;
  const ModeFit stiffer = fit_modes(response);
  ASSERT_EQ(fit.modes.size(), stiffer.modes.size());
  for (std::size_t k = 0; k < fit.modes.size(); ++k) {
    EXPECT_NEAR(stiffer.modes[k].stiffness / (8.0 * fit.modes[k].stiffness), 1.0, 1e-9);
  }
}

TEST(ModeFit, RefusesWhatIsNoResponse) {
  dynamics::MeasuredResponse response = measured({{{kTurn * 700.0, 0.03}, 0.0, 1e4}});
  const auto refused = [](dynamics::MeasuredResponse bad) {
    EXPECT_THROW(fit_modes(bad), core::InputError);
    EXPECT_EQ(dynamics::faults(bad).size(), 1u);
  };
  dynamics::MeasuredResponse bad = response;
  std::swap(bad.omega[7], bad.omega[8]);
  refused(bad);
  bad = response;
  bad.omega.erase(bad.omega.begin() + 100, bad.omega.begin() + 140);
  bad.compliance.erase(bad.compliance.begin() + 100, bad.compliance.begin() + 140);
  refused(bad);
  bad = response;
  for (std::complex<double>& value : bad.compliance) value = std::conj(value);
  refused(bad);
  bad = response;
  for (std::complex<double>& value : bad.compliance) value *= 1e3;
  refused(bad);
  bad = response;
  bad.compliance.pop_back();
  refused(bad);
  EXPECT_THROW(fit_modes(response, 9), core::InputError);
}

}  // namespace
}  // namespace millstudy::identify
