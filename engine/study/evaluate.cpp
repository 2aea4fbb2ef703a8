// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "study/study.h"

namespace millstudy::study {
namespace {

using sweep::Block;
using sweep::Status;

void apply_axes(const Study& study, std::span<const std::int64_t> indices, Case& point) {
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const Axis& axis = study.axes[a];
    if (axis.key->numeric()) {
      apply(*axis.key, axis.numbers[indices[a]], point);
    } else {
      for (const Assignment& assignment : axis.settings[indices[a]]) {
        apply(*assignment.key, assignment.setting, point);
      }
    }
  }
}

bool within(const Limit& limit, const Case& point) {
  const std::optional<double> value = limit.value(point);
  // Bounds are inclusive, for a computed quantity to rounding: 0.2 as 580 / (14500 x 2 / 10)
  // counts.
  constexpr double kRounding = 1e-12;
  if (!value) return false;
  return (!limit.min || *value >= *limit.min - kRounding * std::abs(*limit.min)) &&
         (!limit.max || *value <= *limit.max + kRounding * std::abs(*limit.max));
}

/// Inside every limit. One whose quantity cannot be computed is passed: the point then fails with
/// the reason, unless another limit leaves it out.
bool within_all(const std::vector<Limit>& limits, const Case& point) {
  return std::all_of(limits.begin(), limits.end(), [&](const Limit& limit) {
    try {
      return within(limit, point);
    } catch (const core::CaseError&) {
      return true;
    }
  });
}

/// Reason why the point has no result, or empty. Out of memory is no property of the point: it is
/// passed on.
std::string evaluate_point(const EvaluatePoint& evaluate, const Case& point, std::span<double> row,
                           sweep::Trace* trace) {
  try {
    evaluate(point, row, trace);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  }
  const bool finite =
      std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); });
  return finite ? "" : "a result is not finite";
}

}  // namespace

Case case_at(const Study& study, std::int64_t point) {
  std::vector<std::int64_t> indices(study.axes.size());
  study.space.indices(point, indices);
  Case result = study.base;
  apply_axes(study, indices, result);
  return result;
}

sweep::EvaluateBlock block_evaluator(const Study& study, const std::atomic<bool>* stop) {
  const auto shared = std::make_shared<const Study>(study);
  return [shared, stop, evaluate = study.kind->make_evaluator()](Block& block) {
    std::vector<std::int64_t> indices(shared->axes.size());
    std::vector<double> row(shared->kind->columns.size());
    Case point = shared->base;  // every point of the block sets the same keys
    for (std::int64_t i = 0; i < block.count; ++i) {
      if (stop && stop->load(std::memory_order_relaxed)) return;
      shared->space.indices(block.first + i, indices);
      apply_axes(*shared, indices, point);
      if (!within_all(shared->limits, point)) {
        block.status[i] = Status::skipped;
        continue;
      }
      sweep::Trace* trace = block.traces.empty() ? nullptr : &block.traces[i];
      block.failures[i] = evaluate_point(evaluate, point, row, trace);
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
