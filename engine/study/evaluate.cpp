// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "core/watch.h"
#include "study/point_case.h"
#include "sweep/crash_record.h"

namespace millstudy::study {
namespace {

using sweep::Block;
using sweep::Status;

/// Reason why the point has no result, or empty. Out of memory is no property of the point: it is
/// passed on.
std::string evaluate_point(const EvaluatePoint& evaluate, const std::vector<sweep::Column>& columns,
                           const Case& point, std::span<double> row, sweep::Trace* trace,
                           const core::Watch& watch) {
  try {
    evaluate(point, row, trace);
    if (watch.is_late()) return core::kTooLate;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  }
  for (std::size_t c = 0; c < row.size(); ++c) {
    const bool missing = columns[c].may_be_missing && std::isnan(row[c]);
    if (!std::isfinite(row[c]) && !missing) return columns[c].name + " is not finite";
  }
  return "";
}

}  // namespace

sweep::EvaluateBlock block_evaluator(const Study& study, const std::atomic<bool>* stop) {
  const auto shared = std::make_shared<const Study>(study);
  return [shared, stop, evaluate = study.kind->make_evaluator(study.outputs)](Block& block) {
    sweep::prepare_thread_for_crashes();
    const struct NoPoint {
      ~NoPoint() { sweep::current_point = -1; }
    } afterwards;
    std::vector<double> row(shared->columns.size());
    PointCase points(*shared);
    for (std::int64_t i = 0; i < block.count; ++i) {
      if (stop && stop->load(std::memory_order_relaxed)) return;
      if (block.status[i] != Status::not_run) continue;
      sweep::current_point = block.first + i;
      const Case& point = points.at(block.first + i);
      if (!within_limits(*shared, point)) {
        block.status[i] = Status::skipped;
        continue;
      }
      sweep::Trace* trace = block.traces.empty() ? nullptr : &block.traces[i];
      const core::Watch watch(stop, shared->point_time_limit);
      try {
        block.failures[i] = evaluate_point(evaluate, shared->columns, point, row, trace, watch);
      } catch (const core::Interrupted&) {
        if (trace) *trace = {};
        return;
      }
      if (block.failures[i].empty()) {
        block.status[i] = Status::ok;
        for (std::size_t c = 0; c < row.size(); ++c) block.value(c, i) = row[c];
      } else {
        block.status[i] = Status::failed;
        if (trace) *trace = {};
      }
    }
  };
}

}  // namespace millstudy::study
