// SPDX-License-Identifier: MIT
#include "study/kinds.h"
#include "study/rows.h"

namespace millstudy::study {
namespace {

void no_rules(const Given&, const Case&, Faults&) {}

EvaluatePoint make_evaluator() {
  return [](const Case& point, std::span<double> row, sweep::Trace*) {
    fill_path_row(measured_path(point).figures, row);
  };
}

}  // namespace

const Kind& path_kind() {
  static const Kind kind = {
      .name = "path",
      .help = "interpolate a curve: feed fluctuation, evaluations, chord error",
      .sections = {general_keys(), path_keys(), path_feed_keys()},
      .columns = path_columns(),
      .has_traces = false,
      .check_keys = no_rules,
      .check = no_rules,
      .make_evaluator = make_evaluator,
  };
  return kind;
}

}  // namespace millstudy::study
