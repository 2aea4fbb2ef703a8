// SPDX-License-Identifier: MIT
#include "core/units.h"
#include "study/kinds.h"
#include "study/rows.h"
#include "study/shared_sampler.h"

namespace millstudy::study {
namespace {

void check(const Given& given, const Case& base, Faults& faults) {
  check_cut(given, base, faults);
  check_numerics(given, base, faults);
}

/// One revolution, time from the spindle speed.
sweep::Trace revolution_trace(const Case& point, const force::ForceSamples& samples) {
  sweep::Trace trace;
  for (int s = 0; s < point.angular_steps; ++s) {
    const double turn = static_cast<double>(s) / point.angular_steps;
    trace.time.push_back(static_cast<float>(turn / point.cut.spindle_speed));
    trace.angle.push_back(static_cast<float>(2.0 * core::kPi * turn));
    trace.force_x.push_back(static_cast<float>(samples.x[s]));
    trace.force_y.push_back(static_cast<float>(samples.y[s]));
    trace.force_z.push_back(static_cast<float>(samples.z[s]));
  }
  return trace;
}

EvaluatePoint make_evaluator() {
  return
      [samplers = SharedSamplers()](const Case& point, std::span<double> row, sweep::Trace* trace) {
        const force::Engagement engaged = engagement(point);
        const auto sampler = samplers.get(point, engaged);
        force::ForceSamples samples;
        sampler->sample(point.coefficients, feed_per_tooth(point), 0.0, 0, point.angular_steps,
                        samples);
        force::StatisticsAccumulator statistics;
        statistics.add(samples, point.angular_steps);
        fill_force_row(point, statistics.result(),
                       force::largest_chip_thickness(point.cutter, engaged, feed_per_tooth(point)),
                       row);
        if (trace) *trace = revolution_trace(point, samples);
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
      .check = check,
      .make_evaluator = make_evaluator,
  };
  return kind;
}

}  // namespace millstudy::study
