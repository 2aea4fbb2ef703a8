// SPDX-License-Identifier: MIT
#include "force/figures.h"
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
    const force::FigureRequest request = figure_request(point, outputs);
    const auto sampler = samplers.get(point, engagement(point), request.stick_out.has_value());
    const force::Coefficients coefficients = scaled_coefficients(point);
    const force::Feed feed = {feed_per_tooth(point)};
    force::ForceSamples samples;
    sampler->sample(coefficients, feed, 0, point.angular_steps, samples);
    force::FigureAccumulator figures(request, *sampler);
    figures.add(*sampler, coefficients, feed, 0, point.angular_steps, samples);
    fill_force_row(point, outputs, figures.result(), material_removal_rate(point), row);
    if (!trace) return;
    if (point.measurement.sampling_rate) {
      fill_measured(point, *trace);
    } else {
      append_samples(point, 0, point.angular_steps, samples, *trace);
    }
  };
}

}  // namespace

const Kind& force_kind() {
  static const Kind kind = {
      .name = "force",
      .help = "the cutting force over one revolution, fed along x; or records of it, as measured",
      .sections = {general_keys(), cutter_keys(), coefficient_keys(), cut_keys(), numerics_keys(),
                   measurement_keys(), output_keys()},
      .columns = force_columns,
      .has_traces = true,
      .check_keys =
          [](const Given& given, const Case& base, Faults& faults) {
            check_force_keys(given, base, faults);
            check_measurement(given, base, faults);
          },
      .check = check_force,
      .make_evaluator = make_evaluator,
  };
  return kind;
}

}  // namespace millstudy::study
