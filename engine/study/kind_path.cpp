// SPDX-License-Identifier: MIT
#include "study/kinds.h"
#include "study/rows.h"

namespace millstudy::study {
namespace {

void no_rules(const Given&, const Case&, Faults&) {}

std::vector<sweep::Column> columns(const Outputs&) {
  return path_columns();
}

EvaluatePoint make_evaluator(const Outputs&) {
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
      .columns = columns,
      .has_traces = false,
      .check_keys = no_rules,
      .check = no_rules,
      .make_evaluator = make_evaluator,
  };
  return kind;
}

}  // namespace millstudy::study
