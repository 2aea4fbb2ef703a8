// SPDX-License-Identifier: MIT
// The interpolator at N = 2 against plain Newton on Cox-de Boor evaluation, same chords, same
// number of evaluations, same accuracy. Prints ns per point of both and, last, the ratios.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "benchmark/path_cox_de_boor_baseline.h"
#include "path/figures.h"
#include "path/interpolate.h"
#include "path/reference_curve.h"
#include "unit/path/test_curves.h"

namespace {

using namespace millstudy::path;

constexpr double kChord = 0.12;  // mm: 60 mm/s and 2 ms
constexpr int kIterations = 2;

CurveData curve_data(const std::string& name) {
  return name == "sun2008" ? test::sun2008() : test::butterfly();
}

InterpolationSettings settings(int iterations = kIterations) {
  InterpolationSettings s;
  s.period = 0.002;
  s.feed_rate = kChord / s.period;
  s.max_iterations = iterations;
  return s;
}

void per_point(benchmark::State& state, std::size_t points) {
  state.counters["ns_per_point"] = benchmark::Counter(
      static_cast<double>(points) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void engine_newton(benchmark::State& state, const std::string& name) {
  const Curve curve(curve_data(name));
  std::size_t points = 0;
  for (auto _ : state) {
    const Interpolation path = interpolate(curve, settings());
    points = path.points.size();
    benchmark::DoNotOptimize(path.points.data());
  }
  per_point(state, points);
}

void cox_de_boor_newton(benchmark::State& state, const std::string& name) {
  const ReferenceCurve curve(curve_data(name));
  std::size_t points = 0;
  for (auto _ : state) {
    const baseline::PlainPath path = baseline::plain_newton(curve, kChord, kIterations, 3400);
    points = path.points.size();
    benchmark::DoNotOptimize(path.points.data());
  }
  per_point(state, points);
}

void engine_figures(benchmark::State& state, const std::string& name) {
  const Curve curve(curve_data(name));
  const Interpolation path = interpolate(curve, settings());
  for (auto _ : state) {
    PathFigures figures = path_figures(curve, path);
    benchmark::DoNotOptimize(figures);
  }
  per_point(state, path.points.size());
}

BENCHMARK_CAPTURE(engine_newton, sun2008, std::string("sun2008"));
BENCHMARK_CAPTURE(cox_de_boor_newton, sun2008, std::string("sun2008"));
BENCHMARK_CAPTURE(engine_newton, butterfly, std::string("butterfly"));
BENCHMARK_CAPTURE(cox_de_boor_newton, butterfly, std::string("butterfly"));
BENCHMARK_CAPTURE(engine_figures, sun2008, std::string("sun2008"));
BENCHMARK_CAPTURE(engine_figures, butterfly, std::string("butterfly"));

double fluctuation(const baseline::PlainPath& path) {
  double worst = 0.0;
  for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
    worst = std::max(worst, std::abs(1.0 - norm(path.points[i] - path.points[i - 1]) / kChord));
  }
  return 100.0 * worst;
}

/// Processor time: what other programs do meanwhile is not counted.
template <class Work>
double seconds(int repeats, const Work& work) {
  const std::clock_t start = std::clock();
  for (int i = 0; i < repeats; ++i) work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The median of interleaved pairs, so that a busy machine slows both sides alike.
void print_ratio(const std::string& name) {
  const Curve curve(curve_data(name));
  const ReferenceCurve reference(curve_data(name));
  const Interpolation ours = interpolate(curve, settings());
  const baseline::PlainPath theirs = baseline::plain_newton(reference, kChord, kIterations, 3400);
  const double points = static_cast<double>(ours.points.size());
  const int repeats = static_cast<int>(2e5 / points) + 1;
  struct Pair {
    double engine, plain;
    double ratio() const { return plain / engine; }
  };
  std::vector<Pair> pairs;
  for (int i = 0; i < 15; ++i) {
    const double engine = seconds(repeats, [&] {
      const Interpolation path = interpolate(curve, settings());
      benchmark::DoNotOptimize(path.points.data());
    });
    const double plain = seconds(repeats, [&] {
      const baseline::PlainPath path =
          baseline::plain_newton(reference, kChord, kIterations, ours.points.size());
      benchmark::DoNotOptimize(path.points.data());
    });
    pairs.push_back({engine, plain});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.ratio() < b.ratio(); });
  const Pair& median = pairs[pairs.size() / 2];
  const double ns = 1e9 / (repeats * points);
  std::printf(
      "ratio %s: %.2f (engine %.1f ns per point, Cox-de Boor %.1f; fluctuation %.6g and %.6g "
      "percent, %zu and %zu points)\n",
      name.c_str(), median.ratio(), median.engine * ns, median.plain * ns,
      path_figures(curve, ours).feed_fluctuation_max, fluctuation(theirs), ours.points.size(),
      theirs.points.size());
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  print_ratio("sun2008");
  print_ratio("butterfly");
  return 0;
}
