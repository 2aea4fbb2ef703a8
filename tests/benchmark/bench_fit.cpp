// SPDX-License-Identifier: MIT
// What an iteration of the joint fit costs over the number of samples: model, derivatives and the
// sums of least squares, on one thread. Its baseline is a tenth of the samples.
//
//   bench_fit [--benchmark_...]
#include <benchmark/benchmark.h>
#include <cstdio>
#include <map>
#include <memory>
#include <tbb/global_control.h>

#include "benchmark/median_reporter.h"
#include "identify/joint_problem.h"
#include "unit/identify/synthetic_record.h"

namespace {

using namespace millstudy;
using namespace millstudy::identify;

constexpr std::array<int, 4> kSamples = {1000, 10'000, 100'000, 1'000'000};

struct Case {
  std::vector<Record> records;
  std::unique_ptr<JointProblem> problem;
};

/// One record of a bull-nose slot with runout, its state the true one.
Case make_case(int samples) {
  testing::Truth truth = testing::slot_truth();
  truth.samples = static_cast<std::size_t>(samples);
  Case made;
  made.records.push_back(testing::make_record(truth, "slot"));
  RecordState state;
  state.coefficients.k = {2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};
  state.spindle_speed = truth.spindle_speed;
  state.phase = truth.phase;
  state.runout = {0.009, 0.008};
  made.problem = std::make_unique<JointProblem>(truth.cutter, made.records, FitSettings{},
                                                std::vector<RecordState>{state});
  return made;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  std::map<int, Case> cases;
  for (const int samples : kSamples) {
    cases.emplace(samples, make_case(samples));
    const auto run = [&problem = *cases.at(samples).problem](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(problem.sum(0, problem.states()[0]).squares);
    };
    baseline::add("iteration/" + std::to_string(samples), run, 3);
  }
  baseline::MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (std::size_t i = 1; i < kSamples.size(); ++i) {
    const auto* many = reporter.find("iteration/" + std::to_string(kSamples[i]));
    const auto* few = reporter.find("iteration/" + std::to_string(kSamples[i - 1]));
    if (!many || !few) continue;
    std::printf("%d samples, of a tenth of them: %.1f x, %.0f ns a sample\n", kSamples[i],
                many->ns / few->ns, many->ns / kSamples[i]);
  }
  return 0;
}
