// SPDX-License-Identifier: MIT
#include "study/kinds.h"
#include "study/rows.h"
#include "study/rules.h"
#include "study/shared_sampler.h"

namespace millstudy::study {
namespace {

EvaluatePoint make_evaluator(const Outputs& outputs) {
  return [outputs, samplers = SharedSamplers()](const Case& point, std::span<double> row,
                                                sweep::Trace* trace) {
    check_point_coefficients(point);
    check_feed(point);
    const force::Engagement engaged = engagement(point);
    const auto sampler = samplers.get(point, engaged);
    force::ForceSamples samples;
    sampler->sample(scaled_coefficients(point), feed_per_tooth(point), 0.0, 0, point.angular_steps,
                    samples);
    force::StatisticsAccumulator statistics;
    statistics.add(samples, point.angular_steps);
    ForceFigures figures = no_figures(point, outputs);
    figures.statistics = statistics.result();
    figures.chip_thickness_max =
        force::largest_chip_thickness(point.cutter, engaged, feed_per_tooth(point));
    fill_force_row(point, outputs, figures, row);
    if (trace) append_samples(point, 0, point.angular_steps, samples, *trace);
  };
}

}  // namespace

const Kind& force_kind() {
  static const Kind kind = {
      .name = "force",
      .help = "the cutting force over one revolution, fed along x",
      .sections = {general_keys(), cutter_keys(), coefficient_keys(), cut_keys(), numerics_keys(),
                   output_keys()},
      .columns = force_columns,
      .has_traces = true,
      .check_keys = check_force_keys,
      .check = check_force,
      .make_evaluator = make_evaluator,
  };
  return kind;
}

}  // namespace millstudy::study
