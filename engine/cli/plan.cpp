// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/open_study.h"
#include "cli/progress.h"
#include "core/ordered_parallel.h"

namespace millstudy::cli {
namespace {

struct Estimate {
  double seconds_per_point = 0.0;  ///< on one thread
  double trace_samples_per_point = 0.0;
  double skipped_part = 0.0;
  std::int64_t measured_points = 0;
};

/// Times blocks spread evenly over the study, for about two seconds on one thread.
Estimate measure(const study::Study& study, const sweep::Layout& layout) {
  constexpr double kBudget = 2.0;  // [s]
  constexpr std::int64_t kMostBlocks = 16;
  const sweep::EvaluateBlock evaluate = study::block_evaluator(study);
  const std::int64_t size = sweep::default_block_size(layout);
  const std::int64_t blocks = (layout.points() + size - 1) / size;
  const std::int64_t tried = std::min(blocks, kMostBlocks);
  Estimate estimate;
  double samples = 0.0;
  std::int64_t skipped = 0;
  const auto start = std::chrono::steady_clock::now();
  double seconds = 0.0;
  for (std::int64_t i = 0; i < tried && seconds < kBudget; ++i) {
    const std::int64_t first = (2 * i + 1) * blocks / (2 * tried) * size;
    sweep::Block block(first, std::min(size, layout.points() - first), layout.columns.size(),
                       layout.traces);
    evaluate(block);
    estimate.measured_points += block.count;
    skipped += std::count(block.status.begin(), block.status.end(), sweep::Status::skipped);
    for (const sweep::Trace& trace : block.traces)
      samples += static_cast<double>(trace.time.size());
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  const auto measured = static_cast<double>(estimate.measured_points);
  estimate.seconds_per_point = seconds / measured;
  estimate.trace_samples_per_point = samples / measured;
  estimate.skipped_part = static_cast<double>(skipped) / measured;
  return estimate;
}

double result_bytes(const sweep::Layout& layout, const Estimate& estimate) {
  constexpr double kBytesOfStatus = 1.0 + 4.0;  // int8 and int32
  constexpr double kBytesOfSample = 5.0 * 4.0;
  const double per_point = 8.0 * static_cast<double>(layout.columns.size()) + kBytesOfStatus +
                           kBytesOfSample * estimate.trace_samples_per_point;
  return per_point * static_cast<double>(layout.points());
}

/// One chunk a column in the writer, and the blocks in flight.
double memory_bytes(const sweep::Layout& layout, const Estimate& estimate, int threads) {
  constexpr double kProgram = 30e6;
  constexpr double kChunk = 2.0 * 512.0 * 1024.0;
  const double per_point =
      8.0 * static_cast<double>(layout.columns.size()) + 20.0 * estimate.trace_samples_per_point;
  return kProgram + kChunk * static_cast<double>(layout.columns.size()) +
         4.0 * threads * static_cast<double>(sweep::default_block_size(layout)) * per_point;
}

std::string axis_text(const study::Axis& axis) {
  if (!axis.key->numeric()) return fmt::format("{}", fmt::join(axis.labels, ", "));
  const auto [least, most] = std::minmax_element(axis.numbers.begin(), axis.numbers.end());
  if (axis.numbers.size() <= 6)
    return fmt::format("{} {}", fmt::join(axis.numbers, ", "), axis.key->unit);
  return fmt::format("{} to {} {}", *least, *most, axis.key->unit);
}

}  // namespace

int plan(const StudyOptions& options) {
  const OpenStudy open = open_study(options);
  const sweep::Layout layout = study::layout(open.study);
  const int threads = options.threads > 0 ? options.threads : core::available_threads();
  const Estimate estimate = measure(open.study, layout);
  const double seconds =
      estimate.seconds_per_point * static_cast<double>(layout.points()) / threads;
  const double bytes = result_bytes(layout, estimate);
  const double memory = memory_bytes(layout, estimate, threads);
  if (options.json) {
    nlohmann::json json = {{"name", open.study.name},
                           {"kind", open.study.kind->name},
                           {"study_hash", open.hash},
                           {"points", layout.points()},
                           {"dimensions", layout.dimensions},
                           {"shape", layout.shape},
                           {"threads", threads},
                           {"seconds", seconds},
                           {"seconds_per_point", estimate.seconds_per_point},
                           {"measured_points", estimate.measured_points},
                           {"file_bytes", bytes},
                           {"memory_bytes", memory}};
    fmt::print("{}\n", json.dump(2));
    return kDone;
  }
  fmt::print("{} (kind {})\n{}\n", open.study.name, open.study.kind->name,
             open.study.description.empty() ? "" : open.study.description + "\n");
  for (const study::Axis& axis : open.study.axes) {
    fmt::print("  {:<30} {:>9} values: {}\n", axis.path,
               count_text(static_cast<std::int64_t>(axis.size())), axis_text(axis));
  }
  for (const study::Limit& limit : open.study.limits) {
    fmt::print("  where {} is{}{}\n", limit.quantity,
               limit.min ? fmt::format(" >= {}", *limit.min) : "",
               limit.max ? fmt::format(" <= {}", *limit.max) : "");
  }
  fmt::print("points:  {}{}\n", count_text(layout.points()),
             open.study.limits.empty()
                 ? ""
                 : fmt::format(", about {:.0f} % skipped", 100.0 * estimate.skipped_part));
  fmt::print("time:    about {} on {} thread{} ({} points measured)\n", duration_text(seconds),
             threads, threads == 1 ? "" : "s", count_text(estimate.measured_points));
  fmt::print("memory:  about {}\n", bytes_text(memory));
  fmt::print("file:    at most {}\n", bytes_text(bytes));
  return kDone;
}

}  // namespace millstudy::cli
