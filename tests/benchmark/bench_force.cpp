// SPDX-License-Identifier: MIT
// Force over one revolution of 720 angles: the sampler against 200 discs a tooth.
//
//   bench_force [--benchmark_filter=...]
//
// Prints Google Benchmark's table and then the ratios, from medians of the repetitions. Run it on
// an idle machine: the ratio is of two single-threaded loops, but both share the caches.

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "benchmark/force_disc_baseline.h"
#include "benchmark/median_reporter.h"
#include "core/units.h"
#include "force/sampler.h"
#include "force/statistics.h"

namespace {

using namespace millstudy;

constexpr int kSteps = 720;
constexpr int kDiscs = 200;
constexpr double kFeed = 0.06;
const force::Coefficients kGgg70{2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};

/// haber2004: D 12, two flutes, helix 30 deg, slot.
cutter::Cutter haber(cutter::Shape shape) {
  return {shape, 12.0, 2, core::rad_from_deg(30.0)};
}

void discs(benchmark::State& state, double depth) {
  const cutter::Cutter cutter = haber(cutter::Shape::flat);
  const baseline::DiscForce force(cutter.diameter, cutter.flutes, cutter.helix_angle, depth, kDiscs,
                                  kSteps);
  std::vector<double> x(kSteps), y(kSteps), z(kSteps);
  for (auto _ : state) {
    force.revolution(kGgg70, kFeed, x.data(), y.data(), z.data());
    benchmark::DoNotOptimize(x.data());
    benchmark::ClobberMemory();
  }
  state.counters["discs/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kSteps * kDiscs * cutter.flutes,
                         benchmark::Counter::kIsRate);
}

void sampler(benchmark::State& state, cutter::Shape shape, double depth, force::EdgeRule rule) {
  const force::ForceSampler sampler(haber(shape), force::slot(depth), rule, kSteps);
  force::ForceSamples samples;
  for (auto _ : state) {
    sampler.sample(kGgg70, {kFeed}, 0, kSteps, samples);
    benchmark::DoNotOptimize(samples.x.data());
    benchmark::ClobberMemory();
  }
}

/// An interpolation period of a path: 2 ms at 14 500 rpm and 360 steps, with statistics.
void period(benchmark::State& state, cutter::Shape shape, double depth) {
  const force::ForceSampler sampler(haber(shape), force::slot(depth), {}, 360);
  force::ForceSamples samples;
  force::StatisticsAccumulator statistics;
  std::int64_t first = 0;
  for (auto _ : state) {
    sampler.sample(kGgg70, {kFeed, 1e-3 * static_cast<double>(first)}, first, 174, samples);
    statistics.add(samples, 174);
    first += 174;
    benchmark::ClobberMemory();
  }
  benchmark::DoNotOptimize(statistics.result());
}

void cold(benchmark::State& state, cutter::Shape shape, double depth) {
  for (auto _ : state) {
    const force::ForceSampler sampler(haber(shape), force::slot(depth), {}, kSteps);
    force::ForceSamples samples;
    sampler.sample(kGgg70, {kFeed}, 0, kSteps, samples);
    benchmark::DoNotOptimize(samples.x.data());
    benchmark::ClobberMemory();
  }
}

/// A baseline that computed something else would prove nothing: both must agree to what 200 discs
/// are worth.
bool baseline_agrees(double depth) {
  const cutter::Cutter cutter = haber(cutter::Shape::flat);
  std::vector<double> x(kSteps), y(kSteps), z(kSteps);
  baseline::DiscForce(cutter.diameter, cutter.flutes, cutter.helix_angle, depth, kDiscs, kSteps)
      .revolution(kGgg70, kFeed, x.data(), y.data(), z.data());
  force::ForceSamples exact;
  force::ForceSampler(cutter, force::slot(depth), {}, kSteps)
      .sample(kGgg70, {kFeed}, 0, kSteps, exact);
  double peak = 0.0, off = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    peak = std::max({peak, std::abs(exact.x[i]), std::abs(exact.y[i])});
    off = std::max({off, std::abs(exact.x[i] - x[i]), std::abs(exact.y[i] - y[i]),
                    std::abs(exact.z[i] - z[i])});
  }
  std::printf("baseline against exact, %g mm deep: %.1e of the peak\n", depth, off / peak);
  return off < 1e-2 * peak;
}

void print_ratio(const baseline::MedianReporter& reporter, const std::string& depth) {
  const auto* base = reporter.find("discs_200/" + depth);
  const auto* fast = reporter.find("sampler_flat/" + depth);
  const auto* first = reporter.find("cold_start_flat/" + depth);
  if (!base || !fast || !first) return;
  std::printf(
      "flat, %s deep: exact %.3f us, %.0fx faster than 200 discs a tooth (%.1f us, %.2e discs/s)"
      "; cold start %.1f us, %.1fx\n",
      depth.c_str(), 1e-3 * fast->ns, base->ns / fast->ns, 1e-3 * base->ns, base->discs_per_s,
      1e-3 * first->ns, base->ns / first->ns);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  using baseline::add;
  using cutter::Shape;
  for (const double depth : {0.5, 20.0}) {
    const std::string at = depth < 1.0 ? "0.5mm" : "20mm";
    add("discs_200/" + at, [=](auto& state) { discs(state, depth); });
    add("sampler_flat/" + at, [=](auto& state) { sampler(state, Shape::flat, depth, {}); });
    add("cold_start_flat/" + at, [=](auto& state) { cold(state, Shape::flat, depth); });
  }
  add("sampler_ball/3mm", [](auto& state) { sampler(state, Shape::ball, 3.0, {}); });
  add("cold_start_ball/3mm", [](auto& state) { cold(state, Shape::ball, 3.0); });
  add("sampler_flat_discs_200/0.5mm", [](auto& state) {
    sampler(state, Shape::flat, 0.5, {force::Rule::discs, kDiscs});
  });
  add("path_period_flat/0.5mm", [](auto& state) { period(state, Shape::flat, 0.5); });
  add("path_period_ball/3mm", [](auto& state) { period(state, Shape::ball, 3.0); });
  baseline::MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  print_ratio(reporter, "0.5mm");
  print_ratio(reporter, "20mm");
  return baseline_agrees(0.5) && baseline_agrees(20.0) ? 0 : 1;
}
