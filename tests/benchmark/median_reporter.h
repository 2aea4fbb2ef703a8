// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace millstudy::baseline {

/// Prints the table as ever and keeps the medians.
class MedianReporter : public benchmark::ConsoleReporter {
 public:
  struct Median {
    double ns = 0.0;           ///< a run
    double discs_per_s = 0.0;  ///< of a baseline of discs
  };

  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.aggregate_name != "median") continue;
      Median& median = medians_[run.run_name.function_name];
      median.ns = run.GetAdjustedCPUTime();
      const auto rate = run.counters.find("discs/s");
      if (rate != run.counters.end()) median.discs_per_s = rate->second.value;
    }
  }

  /// Null if a filter left the benchmark out.
  const Median* find(const std::string& name) const {
    const auto found = medians_.find(name);
    return found == medians_.end() ? nullptr : &found->second;
  }

 private:
  std::map<std::string, Median> medians_;
};

/// Registers a benchmark, of which the median of the repetitions counts.
inline void add(const std::string& name, const std::function<void(benchmark::State&)>& function,
                int repetitions = 9) {
  benchmark::RegisterBenchmark(name.c_str(), function)
      ->Repetitions(repetitions)
      ->ReportAggregatesOnly();
}

}  // namespace millstudy::baseline
