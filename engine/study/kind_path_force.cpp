// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include "core/units.h"
#include "process/machine_along.h"
#include "study/kinds.h"
#include "study/rows.h"
#include "study/rules.h"
#include "study/shared_sampler.h"

namespace millstudy::study {
namespace {

constexpr std::size_t kMostPathBytes = 256 << 20;
std::size_t bytes_of(const MeasuredPath& path) {
  return path.interpolation.points.size() * (sizeof(path::Vec3) + sizeof(double));
}

void check(const Given& given, const Case& base, Faults& faults) {
  check_force(given, base, faults);
  if (given.swept("path.curve_file")) return;  // the points that climb too far fail
  const double steepest = base.path.curve->steepest;
  if (steepest > force::kSteepestSlope * (1.0 + 1e-9)) {
    faults.add(
        given.place({"path.curve_file"}),
        fmt::format("the path climbs or falls by {:.6g} deg: kind path_force computes forces up to "
                    "{:.0f} deg",
                    core::deg_from_rad(steepest), core::deg_from_rad(force::kSteepestSlope)));
  }
}

/// How the engagement follows the path: slots, and angles that are given, do not.
process::Immersion immersion(const CutSection& cut) {
  using Side = process::Immersion::Side;
  if (!cut.milling || *cut.milling == Milling::slot) return {};
  return {*cut.milling == Milling::up ? Side::up : Side::down, *cut.radial_depth};
}

class PathForceEvaluator {
 public:
  explicit PathForceEvaluator(const Outputs& outputs) : outputs_(outputs) {}

  void operator()(const Case& point, std::span<double> row, sweep::Trace* trace) const {
    check_point_coefficients(point);
    check_feed(point);
    const force::Engagement engaged = engagement(point);
    const auto path = shared_path(point);
    const force::FigureRequest request = figure_request(point, outputs_);
    const auto sampler = samplers_.get(point, engaged, request.stick_out.has_value());
    const process::Machining machining{point.cutter,
                                       engaged,
                                       scaled_coefficients(point),
                                       point.cut.spindle_speed,
                                       point.angular_steps,
                                       immersion(point.cut),
                                       point.cut.stock,
                                       request};
    const process::PathForces forces = process::machine_along(
        path->interpolation, *sampler, machining, trace ? recorder(point, *trace) : nullptr);
    static const std::size_t path_count = path_columns().size();
    fill_path_row(path->figures, row.first(path_count));
    fill_force_row(point, outputs_, forces.figures, forces.removal_rate, row.subspan(path_count));
  }

 private:
  /// The path of a point, shared by all that differ only in cutter, speed and coefficients.
  std::shared_ptr<const MeasuredPath> shared_path(const Case& point) const {
    const std::string key = share_key({path_keys()}, point, {feed_rate(point)});
    return paths_->get(key, [&] { return measured_path(point); });
  }

  static process::SampleObserver recorder(const Case& point, sweep::Trace& trace) {
    return [&point, &trace](std::int64_t first, std::int64_t count, const force::ForceSamples& f) {
      append_samples(point, first, count, f, trace);
    };
  }

  Outputs outputs_;
  SharedSamplers samplers_;
  std::shared_ptr<core::SharedCache<MeasuredPath>> paths_ =
      std::make_shared<core::SharedCache<MeasuredPath>>(kMostPathBytes, bytes_of);
};

EvaluatePoint make_evaluator(const Outputs& outputs) {
  return PathForceEvaluator(outputs);
}

std::vector<sweep::Column> columns(const Outputs& outputs) {
  std::vector<sweep::Column> all = path_columns();
  const std::vector<sweep::Column> force = force_columns(outputs);
  all.insert(all.end(), force.begin(), force.end());
  return all;
}

}  // namespace

const Kind& path_force_kind() {
  static const Kind kind = {
      .name = "path_force",
      .help = "the cutting force along an interpolated curve, in machine axes",
      .sections = {general_keys(), path_keys(), cutter_keys(), coefficient_keys(), cut_keys(),
                   stock_keys(), numerics_keys(), output_keys()},
      .columns = columns,
      .has_traces = true,
      .check_keys = check_force_keys,
      .check = check,
      .make_evaluator = make_evaluator,
  };
  return kind;
}

}  // namespace millstudy::study
