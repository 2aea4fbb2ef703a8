// SPDX-License-Identifier: MIT
#include "dynamics/dynamometer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::dynamics {
namespace {

constexpr double kInterval = 1e-4;
const Mode kMode = {2.0 * core::kPi * 800.0, 0.04};

std::vector<double> response(const Mode& mode, const std::vector<double>& force,
                             double interval = kInterval) {
  const ModeFilter filter(mode, interval);
  ModeFilter::State state;
  std::vector<double> out;
  for (const double f : force) out.push_back(f + filter.next_deviation(state, f));
  return out;
}

std::vector<double> noise(std::size_t count) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> out(count);
  for (double& x : out) x = normal(random);
  return out;
}

TEST(ModeFilter, KeepsAConstantForce) {
  for (const double x : response(kMode, std::vector<double>(1000, 3.5))) EXPECT_DOUBLE_EQ(x, 3.5);
}

TEST(ModeFilter, IsExactForStraightLinesBetweenSamples) {
  // Each corner of the force begins a ramp response of its own, in long double.
  const std::vector<double> force = noise(400);
  const std::vector<double> found = response(kMode, force);
  const long double w = kMode.natural_frequency, z = kMode.damping_ratio;
  const long double d = w * std::sqrt(1.0L - z * z);
  const auto ramp = [&](long double t) {
    return t - 2.0L * z / w +
           std::exp(-z * w * t) *
               (2.0L * z / w * std::cos(d * t) + (2.0L * z * z - 1.0L) / d * std::sin(d * t));
  };
  double worst = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    long double x = force[0];
    for (std::size_t j = 0; j < i; ++j) {
      const long double before = j == 0 ? 0.0L : (long double)force[j] - force[j - 1];
      const long double corner = ((long double)force[j + 1] - force[j] - before) / kInterval;
      x += corner * ramp(kInterval * (long double)(i - j));
    }
    worst = std::max(worst, std::abs(found[i] - (double)x));
  }
  std::printf("worst against the analytic response: %.1e\n", worst);
  EXPECT_LT(worst, 1e-13);
}

TEST(ModeFilter, IsLinearAndForgetsWhenItBegan) {
  const std::vector<double> a = noise(3000);
  std::vector<double> b = a;
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = 2.0 * a[i] + std::sin(0.1 * (double)i);
  std::vector<double> sine(a.size());
  for (std::size_t i = 0; i < b.size(); ++i) sine[i] = std::sin(0.1 * (double)i);
  const auto xa = response(kMode, a), xb = response(kMode, b), xs = response(kMode, sine);
  const auto late = response(kMode, std::vector<double>(a.begin() + 1000, a.end()));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(xb[i], 2.0 * xa[i] + xs[i], 1e-12);
  for (std::size_t i = 2700; i < a.size(); ++i) EXPECT_NEAR(xa[i], late[i - 1000], 1e-12);
}

TEST(ModeFilter, AddsItsShareOfARunWhereverTheRunIsCut) {
  const std::vector<double> force = noise(500), x = response(kMode, force);
  const ModeFilter filter(kMode, kInterval);
  ModeFilter::State state;
  std::vector<double> signal = force;
  const std::span<const double> whole = force;
  const std::span<double> out = signal;
  for (std::size_t from = 0, size = 1; from < whole.size(); from += size, size *= 3) {
    size = std::min(size, whole.size() - from);
    filter.add_share(state, 0.7, whole.subspan(from, size), out.subspan(from, size));
  }
  for (std::size_t i = 0; i < force.size(); ++i) {
    EXPECT_NEAR(signal[i], force[i] + 0.7 * (x[i] - force[i]), 1e-14);
  }
}

TEST(ModeFilter, HasTheAmplitudeOfItsTransferFunction) {
  // At a fine sampling, where straight lines are a sine.
  constexpr double interval = 1e-6;
  const double frequency = 2.0 * core::kPi * 700.0;
  std::vector<double> force(200000);
  for (std::size_t i = 0; i < force.size(); ++i) {
    force[i] = std::sin(frequency * interval * (double)i);
  }
  const auto x = response(kMode, force, interval);
  const std::array<DynamometerMode, 1> modes = {{{kMode, 1.0}}};
  const std::complex<double> gain = transfer(modes, frequency);
  for (std::size_t i = 190000; i < x.size(); ++i) {
    const double expected =
        std::imag(gain * std::exp(std::complex<double>(0.0, frequency * interval * (double)i)));
    ASSERT_NEAR(x[i], expected, 2e-5 * std::abs(gain));
  }
  EXPECT_DOUBLE_EQ(transfer(modes, 0.0).real(), 1.0);
}

TEST(ModeFilter, HasTheDerivativesOfItsResponse) {
  const std::vector<double> force = noise(500);
  const ModeFilter filter(kMode, kInterval);
  ModeFilter::GradientState gradient;
  std::vector<std::array<double, 2>> found;
  ModeFilter::State state;
  for (const double f : force) {
    EXPECT_EQ(filter.next_deviation(gradient, f), filter.next_deviation(state, f));
    found.push_back({gradient.position_by[0], gradient.position_by[1]});
  }
  for (int q = 0; q < 2; ++q) {
    const double step = q == 0 ? 1e-3 * kMode.natural_frequency : 1e-4;
    const auto moved = [&](double by) {
      Mode mode = kMode;
      (q == 0 ? mode.natural_frequency : mode.damping_ratio) += by;
      return response(mode, force);
    };
    const auto a = moved(step), b = moved(-step), c = moved(2 * step), d = moved(-2 * step),
               e = moved(3 * step), f = moved(-3 * step);
    double size = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      const double difference =
          (45.0 * (a[i] - b[i]) - 9.0 * (c[i] - d[i]) + (e[i] - f[i])) / (60.0 * step);
      size = std::max(size, std::abs(difference));
      worst = std::max(worst, std::abs(difference - found[i][q]));
    }
    std::printf("derivative %d: %.1e\n", q, worst / size);
    EXPECT_LT(worst, 1e-8 * size);
  }
}

TEST(ModeFilter, RefusesModesThatAreNone) {
  EXPECT_THROW(ModeFilter({0.0, 0.1}, kInterval), core::InputError);
  EXPECT_THROW(ModeFilter({100.0, 1.0}, kInterval), core::InputError);
}

}  // namespace
}  // namespace millstudy::dynamics
