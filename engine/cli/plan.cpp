// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/commands.h"
#include "cli/measure.h"
#include "cli/open_study.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "core/parallel_items.h"
#include "io/result_size.h"

namespace millstudy::cli {
namespace {

// What a run takes besides its points, measured on a slow machine.
constexpr double kStart = 0.09;          // [s]
constexpr double kWritingByte = 1.5e-8;  // [s], to the journal and to the result

std::string axis_text(const study::Axis& axis) {
  if (!axis.numeric()) {
    std::vector<std::string> different;  // a sampled axis has each many times
    for (const std::string& label : axis.labels) {
      if (std::find(different.begin(), different.end(), label) != different.end()) continue;
      if (different.size() == 12) return fmt::format("{}, ...", fmt::join(different, ", "));
      different.push_back(label);
    }
    return fmt::format("{}", fmt::join(different, ", "));
  }
  const auto [least, most] = std::minmax_element(axis.numbers.begin(), axis.numbers.end());
  if (axis.numbers.size() <= 6)
    return fmt::format("{} {}", fmt::join(axis.numbers, ", "), axis.key->unit);
  return fmt::format("{} to {} {}", *least, *most, axis.key->unit);
}

}  // namespace

int plan(const StudyOptions& options) {
  const OpenStudy open = open_study(options);
  print_warnings(open.study);
  const int threads = options.threads > 0 ? options.threads : core::available_threads();
  sweep::Layout layout = study::layout(open.study);
  layout.attributes = origin(open, options, threads);
  Estimate estimate = measure(open.study, layout);
  const double samples = estimate.trace_samples_per_point * static_cast<double>(layout.points());
  const double bytes = io::expected_result_bytes(layout, std::move(estimate.blocks), samples);
  const double seconds =
      kStart + kWritingByte * bytes +
      estimate.seconds_per_point * static_cast<double>(layout.points()) / threads;
  const double memory = memory_bytes(layout, estimate.trace_samples_per_point, threads,
                                     sweep::default_block_size(layout, estimate.seconds_per_point));
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
  fmt::print("file:    about {}\n", bytes_text(bytes));
  return kDone;
}

}  // namespace millstudy::cli
