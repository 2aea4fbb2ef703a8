// SPDX-License-Identifier: MIT
// Force over one revolution of 720 angles, for every envelope and every kind of flutes.
//
//   bench_shapes [--tolerance=1e-4] [--benchmark_filter=...]
//
// First the sampler against as many discs a tooth as they need for an error of 1e-4 of the peak, or
// what is asked for; the number is searched for and printed. Then unequal flutes, runout (also with
// a tilted axis, or unequal helix angles) and the size effect against equal flutes, whose prepared
// series are the fast path. Ratios are of medians. Run it on an idle machine.

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "benchmark/general_disc_baseline.h"
#include "benchmark/median_reporter.h"
#include "benchmark/take_option.h"
#include "core/units.h"
#include "force/sampler.h"

namespace {

using namespace millstudy;
using core::rad_from_deg;

constexpr int kSteps = 720;
constexpr double kFeed = 0.06;
constexpr int kMostDiscs = 1 << 20;
const force::Coefficients kGgg70{2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};

struct Cut {
  std::string name;
  cutter::Shape shape;
  double corner_radius;
  double taper_deg;
  double depth;
  double required;  ///< times faster than discs of 1e-4, 0 if that is measured elsewhere
};

const Cut kCuts[] = {
    {"flat", cutter::Shape::flat, 0.0, 0.0, 0.5, 0.0},
    {"taper", cutter::Shape::taper, 0.0, 10.0, 10.0, 20.0},
    {"bull_nose", cutter::Shape::bull_nose, 3.0, 0.0, 3.0, 200.0},
    {"ball", cutter::Shape::ball, 0.0, 0.0, 3.0, 200.0},
};

/// What makes a cutter other than one of equal flutes and constant coefficients.
enum class Kind { equal, pitch, helix, runout, tilt, helix_and_runout, size_effect };
constexpr Kind kKinds[] = {Kind::equal,      Kind::pitch, Kind::helix,
                           Kind::runout,     Kind::tilt,  Kind::helix_and_runout,
                           Kind::size_effect};

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::equal:
      return "equal";
    case Kind::pitch:
      return "variable_pitch";
    case Kind::helix:
      return "variable_helix";
    case Kind::runout:
      return "runout";
    case Kind::tilt:
      return "runout_and_tilt";
    case Kind::helix_and_runout:
      return "variable_helix_and_runout";
    case Kind::size_effect:
      break;
  }
  return "size_effect";
}

cutter::Cutter cutter_of(const Cut& cut, int flutes, Kind kind) {
  cutter::Cutter cutter{cut.shape, 12.0, flutes, rad_from_deg(30.0)};
  cutter.corner_radius = cut.corner_radius;
  cutter.taper_angle = rad_from_deg(cut.taper_deg);
  for (int j = 0; j < flutes; ++j) {
    const double sign = j % 2 == 0 ? 1.0 : -1.0;
    if (kind == Kind::pitch) {
      cutter.pitch_angles.push_back(2.0 * core::kPi / flutes +
                                    sign * rad_from_deg(10.0 - 2.5 * (j / 2)));
    }
    if (kind == Kind::helix || kind == Kind::helix_and_runout)
      cutter.helix_angles.push_back(rad_from_deg(31.0 + sign));
  }
  if (kind == Kind::runout || kind == Kind::tilt || kind == Kind::helix_and_runout) {
    cutter.runout = {0.01, 0.3};
  }
  if (kind == Kind::tilt) cutter.runout.tilt = rad_from_deg(0.05);
  return cutter;
}

force::ForceSampler sampler_of(const Cut& cut, int flutes, Kind kind) {
  force::Variation variation;
  if (kind == Kind::size_effect) variation.size_exponent = {0.2, 0.2, 0.2};
  return {cutter_of(cut, flutes, kind), force::slot(cut.depth), {}, kSteps, variation};
}

std::string name_of(const Cut& cut, int flutes, Kind kind) {
  return std::string(name_of(kind)) + "/" + cut.name + "/" + std::to_string(flutes);
}

void sample(benchmark::State& state, const Cut& cut, int flutes, Kind kind) {
  const force::ForceSampler sampler = sampler_of(cut, flutes, kind);
  force::ForceSamples samples;
  for (auto _ : state) {
    sampler.sample(kGgg70, {kFeed}, 0, kSteps, samples);
    benchmark::DoNotOptimize(samples.x.data());
    benchmark::ClobberMemory();
  }
}

void cold(benchmark::State& state, const Cut& cut, int flutes, Kind kind) {
  for (auto _ : state) {
    force::ForceSampler sampler = sampler_of(cut, flutes, kind);
    benchmark::DoNotOptimize(sampler);
  }
}

baseline::GeneralDiscForce discs_of(const Cut& cut, int discs) {
  const force::CuttingEdges edges(cutter_of(cut, 2, Kind::equal), cut.depth, {});
  return {edges, discs, kSteps};
}

void run_discs(benchmark::State& state, const Cut& cut, int discs) {
  const baseline::GeneralDiscForce force = discs_of(cut, discs);
  std::vector<double> x(kSteps), y(kSteps), z(kSteps);
  for (auto _ : state) {
    force.revolution(kGgg70, kFeed, x.data(), y.data(), z.data());
    benchmark::DoNotOptimize(x.data());
    benchmark::ClobberMemory();
  }
  state.counters["discs/s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * kSteps * discs * 2, benchmark::Counter::kIsRate);
}

/// Largest difference of discs from the exact forces, over the peak, at all angles.
double error_of(const Cut& cut, const force::ForceSamples& exact, int discs) {
  std::vector<double> x(kSteps), y(kSteps), z(kSteps);
  discs_of(cut, discs).revolution(kGgg70, kFeed, x.data(), y.data(), z.data());
  double peak = 0.0, off = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    peak = std::max({peak, std::abs(exact.x[i]), std::abs(exact.y[i]), std::abs(exact.z[i])});
    off = std::max({off, std::abs(exact.x[i] - x[i]), std::abs(exact.y[i] - y[i]),
                    std::abs(exact.z[i] - z[i])});
  }
  return off / peak;
}

/// How many discs a tooth are accurate to a part of the peak force: by doubling, and then by
/// halving the last doubling three times, so that the baseline is not charged for up to twice what
/// it needs. 0 if kMostDiscs are not: then they are not discs of the same force.
int discs_needed(const Cut& cut, double tolerance) {
  force::ForceSamples exact;
  sampler_of(cut, 2, Kind::equal).sample(kGgg70, {kFeed}, 0, kSteps, exact);
  int discs = 64;
  double error = error_of(cut, exact, discs);
  while (error > tolerance && discs < kMostDiscs) {
    discs *= 2;
    error = error_of(cut, exact, discs);
  }
  std::printf("%s, %g mm deep: ", cut.name.c_str(), cut.depth);
  if (error > tolerance) {
    std::printf("%d discs a tooth are still wrong by %.1e of the peak\n", discs, error);
    return 0;
  }
  for (int step = discs / 4, tries = 0; tries < 3; step /= 2, ++tries) {
    const double error_of_fewer = error_of(cut, exact, discs - step);
    if (error_of_fewer > tolerance) continue;
    discs -= step;
    error = error_of_fewer;
  }
  std::printf("%d discs a tooth are wrong by %.2e of the peak\n", discs, error);
  return discs;
}

void print_against_discs(const baseline::MedianReporter& reporter, const Cut& cut) {
  const auto* base = reporter.find("discs/" + cut.name);
  const auto* exact = reporter.find(name_of(cut, 2, Kind::equal));
  if (!base || !exact) return;
  std::printf(
      "%-9s %4.3g mm deep: exact %6.2f us, discs %9.1f us (%.2e discs/s): %6.0fx (required %gx)\n",
      cut.name.c_str(), cut.depth, 1e-3 * exact->ns, 1e-3 * base->ns, base->discs_per_s,
      base->ns / exact->ns, cut.required);
}

/// One row: time over that of equal flutes, and in us; then the cold start.
void print_kinds(const baseline::MedianReporter& reporter, const Cut& cut, int flutes) {
  const auto* equal = reporter.find(name_of(cut, flutes, Kind::equal));
  if (!equal) return;
  std::printf("%-9s %d flutes: equal %6.2f us", cut.name.c_str(), flutes, 1e-3 * equal->ns);
  for (const Kind kind : kKinds) {
    const auto* other = reporter.find(name_of(cut, flutes, kind));
    if (other && other != equal) std::printf("; %s %.1fx", name_of(kind), other->ns / equal->ns);
  }
  const auto print_over = [&](Kind kind, Kind base) {
    const auto* one = reporter.find(name_of(cut, flutes, kind));
    const auto* two = reporter.find(name_of(cut, flutes, base));
    if (one && two)
      std::printf("; %s over %s %.1fx", name_of(kind), name_of(base), one->ns / two->ns);
  };
  print_over(Kind::runout, Kind::pitch);
  print_over(Kind::helix_and_runout, Kind::helix);
  std::printf("\n");
}

void print_cold(const baseline::MedianReporter& reporter, const Cut& cut, int flutes) {
  std::printf("%-9s %d flutes: cold start", cut.name.c_str(), flutes);
  for (const Kind kind : kKinds) {
    const auto* start = reporter.find("cold_" + name_of(cut, flutes, kind));
    if (start) std::printf("; %s %.0f us", name_of(kind), 1e-3 * start->ns);
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const double tolerance = std::max(1e-6, baseline::take_option(argc, argv, "--tolerance=", 1e-4));
  // Many benchmarks: a tenth of the usual time each, unless the command line has another, and their
  // repetitions in random order, so that a clock that changes meanwhile changes all of them.
  std::string time = "--benchmark_min_time=0.05";
  std::string order = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments = {argv[0], time.data(), order.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());

  bool agree = true;
  for (const Cut& cut : kCuts) {
    if (cut.required == 0.0) continue;
    const int discs = discs_needed(cut, tolerance);
    agree = agree && discs > 0;
    if (discs > 0) {
      baseline::add(
          "discs/" + cut.name, [&, discs](auto& state) { run_discs(state, cut, discs); }, 3);
    }
  }
  for (const Cut& cut : kCuts) {
    for (const int flutes : {2, 4}) {
      for (const Kind kind : kKinds) {
        const std::string name = name_of(cut, flutes, kind);
        baseline::add(name, [&, flutes, kind](auto& state) { sample(state, cut, flutes, kind); });
        baseline::add("cold_" + name,
                      [&, flutes, kind](auto& state) { cold(state, cut, flutes, kind); });
      }
    }
  }
  baseline::MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const Cut& cut : kCuts) print_against_discs(reporter, cut);
  for (const Cut& cut : kCuts) {
    for (const int flutes : {2, 4}) print_kinds(reporter, cut, flutes);
  }
  for (const Cut& cut : kCuts) {
    for (const int flutes : {2, 4}) print_cold(reporter, cut, flutes);
  }
  return agree ? 0 : 1;
}
