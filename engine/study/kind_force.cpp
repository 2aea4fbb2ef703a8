// SPDX-License-Identifier: MIT
#include "force/chip_thickness.h"
#include "study/kinds.h"
#include "study/rows.h"
#include "study/shared_sampler.h"

namespace millstudy::study {
namespace {

void check(const Given& given, const Case& base, Faults& faults) {
  check_cut(given, base, faults);
  check_numerics(given, base, faults);
}

EvaluatePoint make_evaluator() {
  return [samplers = SharedSamplers()](const Case& point, std::span<double> row,
                                       sweep::Trace* trace) {
    check_feed(point);
    const force::Engagement engaged = engagement(point);
    const auto sampler = samplers.get(point, engaged);
    force::ForceSamples samples;
    sampler->sample(point.coefficients, {feed_per_tooth(point)}, 0, point.angular_steps, samples);
    force::StatisticsAccumulator statistics;
    statistics.add(samples, point.angular_steps);
    fill_force_row(point, statistics.result(),
                   force::largest_chip_thickness(point.cutter, engaged, {feed_per_tooth(point)}),
                   row);
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
      .columns = force_columns(),
      .has_traces = true,
      .check_keys = check_cut_keys,
      .check = check,
      .make_evaluator = make_evaluator,
  };
  return kind;
}

}  // namespace millstudy::study
