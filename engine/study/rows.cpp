// SPDX-License-Identifier: MIT
#include "study/rows.h"

#include "core/units.h"

namespace millstudy::study {

std::vector<sweep::Column> path_columns() {
  return {
      {"feed_fluctuation_max", "percent", "largest feed fluctuation"},
      {"feed_fluctuation_rms", "percent", "root mean square feed fluctuation"},
      {"feed_fluctuation_l2", "percent", "Euclidean norm of the feed fluctuations"},
      {"steps", "1", "full interpolation steps"},
      {"curve_evaluations", "1", "evaluations of the curve"},
      {"fallback_steps", "1", "steps taken by the bracketed fallback"},
      {"path_length", "mm", "arc length of the path"},
      {"path_time", "s", "time along the path"},
      {"chord_error_max", "mm", "largest distance between chord and curve"},
  };
}

void fill_path_row(const path::PathFigures& figures, std::span<double> row) {
  std::size_t c = 0;
  for (const double value :
       {figures.feed_fluctuation_max, figures.feed_fluctuation_rms, figures.feed_fluctuation_l2,
        figures.steps, figures.curve_evaluations, figures.fallback_steps, figures.path_length,
        figures.path_time, figures.chord_error_max}) {
    row[c++] = value;
  }
}

void append_samples(const Case& point, std::int64_t first, std::int64_t count,
                    const force::ForceSamples& samples, sweep::Trace& trace) {
  for (std::int64_t i = 0; i < count; ++i) {
    const double turn = static_cast<double>(first + i) / point.angular_steps;
    trace.time.push_back(static_cast<float>(turn / point.cut.spindle_speed));
    trace.angle.push_back(static_cast<float>(core::kTurn * turn));
    trace.force_x.push_back(static_cast<float>(samples.x[i]));
    trace.force_y.push_back(static_cast<float>(samples.y[i]));
    trace.force_z.push_back(static_cast<float>(samples.z[i]));
  }
}

MeasuredPath measured_path(const Case& point) {
  path::InterpolationSettings settings = point.path.interpolation;
  settings.feed_rate = feed_rate(point);
  MeasuredPath result{path::interpolate(point.path.curve->curve, settings), {}};
  result.figures = path::path_figures(point.path.curve->curve, result.interpolation);
  return result;
}

}  // namespace millstudy::study
