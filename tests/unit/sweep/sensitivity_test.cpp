// SPDX-License-Identifier: MIT
#include "sweep/sensitivity.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

#include "sweep/sampling.h"

namespace millstudy::sweep {
namespace {

using Function = std::function<double(const std::vector<double>&)>;

/// Values of a function of the unit cube over a design.
std::vector<double> evaluate(std::int64_t groups, int axes, const Function& function,
                             std::uint64_t seed = 1) {
  std::vector<std::vector<double>> places;
  for (int axis = 0; axis < axes; ++axis) places.push_back(saltelli(groups, axes, axis, seed));
  std::vector<double> values;
  std::vector<double> x(axes);
  for (std::size_t point = 0; point < places[0].size(); ++point) {
    for (int axis = 0; axis < axes; ++axis) x[axis] = places[axis][point];
    values.push_back(function(x));
  }
  return values;
}

/// T. Ishigami, T. Homma, ISUMA 1990, with a = 7 and b = 0.1.
double ishigami(const std::vector<double>& u) {
  const auto x = [&](int i) { return std::numbers::pi * (2.0 * u[i] - 1.0); };
  return std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) +
         0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

struct Exact {
  std::vector<double> first, total;
};

Exact ishigami_indices() {
  const double pi4 = std::pow(std::numbers::pi, 4);
  const double one = 0.5 * std::pow(1.0 + 0.1 * pi4 / 5.0, 2);
  const double two = 49.0 / 8.0;
  const double both = 0.01 * pi4 * pi4 * (1.0 / 18.0 - 1.0 / 50.0);
  const double all = one + two + both;
  return {{one / all, two / all, 0.0}, {(one + both) / all, two / all, both / all}};
}

const std::vector<double> kWeights = {0.0, 1.0, 4.5, 9.0, 99.0, 99.0};

/// I.M. Sobol', Math. Comput. Simul. 55 (2001) 271-280.
double g_function(const std::vector<double>& u) {
  double product = 1.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    product *= (std::abs(4.0 * u[i] - 2.0) + kWeights[i]) / (1.0 + kWeights[i]);
  }
  return product;
}

Exact g_indices() {
  double all = 1.0;
  std::vector<double> own;
  for (const double a : kWeights) {
    own.push_back(1.0 / (3.0 * (1.0 + a) * (1.0 + a)));
    all *= 1.0 + own.back();
  }
  Exact exact;
  for (const double v : own) {
    exact.first.push_back(v / (all - 1.0));
    exact.total.push_back(v * all / (1.0 + v) / (all - 1.0));
  }
  return exact;
}

double largest_error(const Sensitivity& found, const Exact& exact) {
  double error = 0.0;
  for (std::size_t i = 0; i < found.axes.size(); ++i) {
    error = std::max(error, std::abs(found.axes[i].first.value - exact.first[i]));
    error = std::max(error, std::abs(found.axes[i].total.value - exact.total[i]));
  }
  return error;
}

TEST(Sensitivity, GivesTheExactIndicesOfTheIshigamiFunction) {
  const double few =
      largest_error(sobol_indices(evaluate(1 << 14, 3, ishigami), 3), ishigami_indices());
  const double many =
      largest_error(sobol_indices(evaluate(1 << 17, 3, ishigami), 3), ishigami_indices());
  std::printf("Ishigami: 2^14 groups within %.2g, 2^17 within %.2g\n", few, many);
  EXPECT_LT(few, 1.1e-3);
  EXPECT_LT(many, 3e-4);
}

TEST(Sensitivity, GivesTheExactIndicesOfTheGFunction) {
  const double error =
      largest_error(sobol_indices(evaluate(1 << 14, 6, g_function), 6), g_indices());
  std::printf("g function: 2^14 groups within %.2g\n", error);
  EXPECT_LT(error, 2.2e-4);
}

TEST(Sensitivity, IntervalsHoldTheExactIndices) {
  const Exact exact = ishigami_indices();
  int held = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Sensitivity found = sobol_indices(evaluate(512, 3, ishigami, seed), 3);
    for (int i = 0; i < 3; ++i) {
      const auto& [first, total] = found.axes[i];
      EXPECT_LE(first.low, first.value);
      EXPECT_LE(first.value, first.high);
      held += first.low <= exact.first[i] && exact.first[i] <= first.high;
      held += total.low <= exact.total[i] && exact.total[i] <= total.high;
      all += 2;
    }
  }
  std::printf("the exact index is in %d of %d intervals\n", held, all);
  EXPECT_GE(held, all * 93 / 100);  // more than 95 %: the sequence is better than chance
}

TEST(Sensitivity, DoesNotDependOnScaleAndMean) {
  const auto scaled = [](const std::vector<double>& u) { return 1e6 - 3.0 * ishigami(u); };
  const Sensitivity a = sobol_indices(evaluate(1024, 3, ishigami), 3);
  const Sensitivity b = sobol_indices(evaluate(1024, 3, scaled), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(a.axes[i].first.value, b.axes[i].first.value, 1e-9);
    EXPECT_NEAR(a.axes[i].total.low, b.axes[i].total.low, 1e-9);
  }
  EXPECT_NEAR(b.variance, 9.0 * a.variance, 1e-8 * b.variance);
}

TEST(Sensitivity, OfAnAdditiveFunctionSumsToOne) {
  const auto sum = [](const std::vector<double>& u) { return u[0] + 2.0 * u[1] - 3.0 * u[2]; };
  const Sensitivity found = sobol_indices(evaluate(1 << 14, 3, sum), 3);
  double first = 0.0;
  for (const SobolIndex& index : found.axes) {
    EXPECT_NEAR(index.first.value, index.total.value, 2e-3);
    first += index.first.value;
  }
  EXPECT_NEAR(first, 1.0, 3e-3);
}

TEST(Sensitivity, LeavesIncompleteGroupsOutAndCountsThem) {
  std::vector<double> values = evaluate(1024, 3, ishigami);
  std::vector<double> without(values.begin() + 5, values.end());
  values[3] = std::nan("");
  const Sensitivity some = sobol_indices(values, 3);
  const Sensitivity rest = sobol_indices(without, 3);
  EXPECT_EQ(some.dropped, 1);
  EXPECT_EQ(some.groups, 1023);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(some.axes[i].first.value, rest.axes[i].first.value);
    EXPECT_EQ(some.axes[i].total.high, rest.axes[i].total.high);
  }
}

TEST(Sensitivity, OfAConstantIsNoNumber) {
  const auto constant = [](const std::vector<double>&) { return 0.1; };
  EXPECT_TRUE(std::isnan(sobol_indices(evaluate(64, 2, constant), 2).axes[0].first.value));
  EXPECT_TRUE(std::isnan(sobol_indices({}, 2).axes[0].total.value));
}

}  // namespace
}  // namespace millstudy::sweep
