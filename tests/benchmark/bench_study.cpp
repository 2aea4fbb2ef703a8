// SPDX-License-Identifier: MIT
// The main study as the program runs it, on two threads against one, and what the engine around
// the computation (plan, scheduling, journal, HDF5) costs. Runs are interleaved, so that a busy
// machine slows all alike; read the row ggg70_slot_median.
//
//   bench_study [PAIRS [FEED_RATES]]     5 pairs of the whole study take a quarter of an hour;
//                                        FEED_RATES takes fewer values of that axis
#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "io/result_writer.h"
#include "io/toml_reader.h"
#include "study/study.h"
#include "sweep/journal.h"
#include "sweep/runner.h"

namespace {

using namespace millstudy;

const std::string kStudy = MILLSTUDY_SOURCE_DIR "/studies/ggg70_slot.toml";

template <class Work>
double wall_seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// @param feed_rates  0: the whole study; else so many, at as many spindle speeds
core::Value study_tree(int feed_rates) {
  core::Value root = io::read_toml(kStudy);
  core::Value* axes = root.find("sweep")->find("axes");
  for (const char* key : {"cut.feed_rate_mm_per_min", "cut.spindle_speed_rpm"}) {
    if (feed_rates > 0) axes->find(key)->find("count")->data = std::int64_t{feed_rates};
  }
  return root;
}

class JournalSink : public sweep::Sink {
 public:
  explicit JournalSink(sweep::Journal& journal) : journal_(journal) {}
  void write(const sweep::Block& block) override { journal_.append(block, {block.seconds}); }
  void finish(const std::vector<sweep::Attribute>&) override {}

 private:
  sweep::Journal& journal_;
};

/// All that `millstudy run` does.
std::int64_t whole_run(int feed_rates, int threads) {
  const study::Study study = study::resolve(study_tree(feed_rates), io::read_toml);
  const sweep::Layout layout = study::layout(study);
  const std::string path =
      (std::filesystem::temp_directory_path() / "millstudy_bench_study.h5").string();
  sweep::JournalHeader header;
  header.points = header.count = layout.points();
  header.block_size = sweep::default_block_size(layout);
  header.columns = static_cast<std::int64_t>(layout.columns.size());
  sweep::Journal journal(path + ".journal", header, "");
  JournalSink appended(journal);
  sweep::run_blocks(study::block_evaluator(study), appended, sweep::remainder(journal),
                    {.threads = threads});
  const auto sink = io::make_result_writer(path, layout);
  sweep::replay(journal, *sink);
  sink->finish({});
  journal.remove();
  std::filesystem::remove(path);
  return layout.points();
}

/// The baseline of the overhead: the same points one after another, nothing around them.
void bare_computation(int feed_rates) {
  const study::Study study = study::resolve(study_tree(feed_rates), io::read_toml);
  const study::EvaluatePoint evaluate = study.kind->make_evaluator(study.outputs);
  std::vector<double> row(study.columns.size());
  for (std::int64_t i = 0; i < study.space.points(); ++i) {
    const study::Case point = study::case_at(study, i);
    if (study::feed_per_tooth(point) <= 0.15 * (1.0 + 1e-12)) evaluate(point, row, nullptr);
  }
}

/// One pair, and the bare computation beside it; Google Benchmark takes the medians of counters.
void ggg70_slot(benchmark::State& state, int feed_rates) {
  for (auto _ : state) {
    std::int64_t points = 0;
    const double one = wall_seconds([&] { points = whole_run(feed_rates, 1); });
    const double two = wall_seconds([&] { whole_run(feed_rates, 2); });
    const double bare = wall_seconds([&] { bare_computation(feed_rates); });
    state.counters["points"] = static_cast<double>(points);
    state.counters["one_thread_s"] = one;
    state.counters["two_threads_s"] = two;
    state.counters["speedup"] = one / two;
    state.counters["overhead_percent"] = 100.0 * (1.0 - bare / one);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const int pairs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const int feed_rates = argc > 2 ? std::max(2, std::atoi(argv[2])) : 0;
  benchmark::RegisterBenchmark("ggg70_slot", [=](auto& state) { ggg70_slot(state, feed_rates); })
      ->Iterations(1)
      ->Repetitions(pairs)
      ->Unit(benchmark::kSecond)
      ->UseRealTime();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
