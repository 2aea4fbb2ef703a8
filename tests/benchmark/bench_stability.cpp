// SPDX-License-Identifier: MIT
// Stability: products by structure against dense ones, boundaries against filled charts.
//
//   bench_stability [--speeds=N] [--benchmark_filter=...]
//
// The radius of the slot of Insperger and Stepan by semi-discretization of order 0, against the
// textbook product of dense matrices and its eigenvalues (Eigen), which must agree to 1e-9. Then
// the limit of depth over N speeds (400), against the chart of N x 200 points, both to 0.1 %.
// Ratios are of medians, on one thread. Run it on an idle machine.

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <string>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "benchmark/median_reporter.h"
#include "benchmark/take_option.h"
#include "dynamics/depth_limit.h"
#include "dynamics/floquet.h"
#include "unit/dynamics/insperger.h"

namespace {

using namespace millstudy;
using namespace millstudy::dynamics;

constexpr double kRpm = 5000.0, kDepth = 3.0;
constexpr int kDepths = 200;
constexpr double kDeepest = 10.0;

/// The spectral radius as T. Insperger, G. Stepan (2004) print it: one dense matrix for each of p
/// intervals, of the state and p + 1 stored positions.
double dense_radius(int p) {
  const DelaySystem system = testing::insperger_slot(kRpm, kDepth);
  const AveragedGains gains = system.averages(p);
  const AxisMode mode = testing::insperger_machine().x[0];
  const double w = mode.mode.natural_frequency, h = system.period / p;
  const int size = p + 2;
  Eigen::MatrixXd product = Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i < p; ++i) {
    Eigen::Matrix2d a;
    a << 0.0, 1.0, -w * w - gains.direct[i](0, 0) / mode.mass, -2.0 * mode.mode.damping_ratio * w;
    const Eigen::Matrix2d exponential = (a * h).exp();
    const Eigen::Vector2d force(0.0, gains.delayed[i](0, 0) / mode.mass);
    const Eigen::Vector2d drive =
        a.inverse() * ((exponential - Eigen::Matrix2d::Identity()) * force);
    Eigen::MatrixXd step = Eigen::MatrixXd::Zero(size, size);
    step.topLeftCorner<2, 2>() = exponential;
    step.block<2, 1>(0, size - 1) += 0.5 * drive;
    step.block<2, 1>(0, size - 2) += 0.5 * drive;
    step(2, 0) = 1.0;
    for (int k = 3; k < size; ++k) step(k, k - 1) = 1.0;
    product = step * product;
  }
  return product.eigenvalues().cwiseAbs().maxCoeff();
}

double radius(int intervals) {
  return floquet(testing::insperger_slot(kRpm, kDepth), {1e-3, intervals, 0, false})
      .spectral_radius;
}

Machine two_in_each() {
  const double turn = 2.0 * core::kPi;
  Machine machine;
  machine.x = {{{452.8 * turn, 0.12}, 0.0, 1.0e4}, {{1448.5 * turn, 0.0170}, 0.0, 8.0e4}};
  machine.y = {{{516.3 * turn, 0.024}, 0.0, 9.7e3}, {{1407.0 * turn, 0.032}, 0.0, 4.0e4}};
  return machine;
}

struct Lobes {
  const char* name;
  Machine machine;
};

DelaySystem at(const Lobes& lobes, double rpm, double depth) {
  return delay_system(lobes.machine,
                      {testing::insperger_cutter(), force::slot(depth), testing::kInsperger},
                      testing::spindle(rpm));
}

double rpm_of(int i, int speeds) {
  return 5000.0 + 20000.0 * i / speeds;
}

void chart(benchmark::State& state, const Lobes& lobes, int speeds) {
  for (auto _ : state) {
    for (int i = 0; i < speeds; ++i) {
      for (int k = 1; k <= kDepths; ++k) {
        const DelaySystem system = at(lobes, rpm_of(i, speeds), kDeepest * k / kDepths);
        benchmark::DoNotOptimize(floquet(system, {1e-3}).spectral_radius);
      }
    }
  }
}

void boundary(benchmark::State& state, const Lobes& lobes, int speeds) {
  DepthSearch search;
  search.largest_depth = kDeepest;
  for (auto _ : state) {
    for (int i = 0; i < speeds; ++i) {
      const double rpm = rpm_of(i, speeds);
      benchmark::DoNotOptimize(
          depth_limits([&](double depth) { return at(lobes, rpm, depth); }, search));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int speeds =
      std::max(1, static_cast<int>(baseline::take_option(argc, argv, "--speeds=", 400)));
  benchmark::Initialize(&argc, argv);
  const std::vector<Lobes> all = {{"insperger_lobes", testing::insperger_machine()},
                                  {"two_modes_in_x_and_y", two_in_each()}};
  const std::vector<int> dense = {40, 200}, structured = {40, 200, 1000, 10000};
  bool agree = true;
  for (const int p : dense) {
    const double found = radius(p), expected = dense_radius(p);
    agree = agree && std::abs(found - expected) <= 1e-9 * expected;
    std::printf("%d intervals: %.12f, dense %.12f\n", p, found, expected);
    const auto run = [p](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(dense_radius(p));
    };
    baseline::add("dense/" + std::to_string(p), run, 3);
  }
  for (const int p : structured) {
    const auto run = [p](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(radius(p));
    };
    baseline::add("structured/" + std::to_string(p), run, 3);
  }
  for (const Lobes& lobes : all) {
    const std::string name = lobes.name;
    baseline::add(
        "boundary/" + name, [&](auto& state) { boundary(state, lobes, speeds); }, 2);
    baseline::add(
        "chart/" + name, [&](auto& state) { chart(state, lobes, speeds); }, 2);
  }
  baseline::MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const auto ratio = [&](const std::string& slow, const std::string& fast, const char* words) {
    const auto *a = reporter.find(slow), *b = reporter.find(fast);
    if (a && b) std::printf("%-60s %8.1f x\n", words, a->ns / b->ns);
  };
  ratio("dense/40", "structured/40", "radius, 40 intervals, than dense products (20)");
  ratio("dense/200", "structured/200", "radius, 200 intervals, than dense products (2000)");
  ratio("structured/10000", "structured/1000", "10 000 intervals cost, of 1000");
  ratio("chart/insperger_lobes", "boundary/insperger_lobes", "boundary than chart, one mode (20)");
  ratio("chart/two_modes_in_x_and_y", "boundary/two_modes_in_x_and_y",
        "boundary than chart, four modes (20)");
  return agree ? 0 : 1;
}
