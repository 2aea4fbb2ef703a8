// SPDX-License-Identifier: MIT
#include "identify/fit_parameters.h"

#include <algorithm>
#include <fmt/core.h>
#include <limits>

#include "core/units.h"

namespace millstudy::identify {
namespace {

using Kind = Parameter::Kind;

constexpr std::array<const char*, 6> kCoefficientNames = {"Ktc", "Krc", "Kac", "Kte", "Kre", "Kae"};

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

bool is_fitted(const FitSettings& settings, int axis) {
  return settings.axes[axis];
}

}  // namespace

double& value_of(RecordState& state, const Parameter& p) {
  switch (p.kind) {
    case Kind::coefficient:
      return state.coefficients.k[p.index];
    case Kind::size_exponent:
      return state.coefficients.size_exponent;
    case Kind::phase:
      return state.phase;
    case Kind::spindle_speed:
      return state.spindle_speed;
    case Kind::runout:
      return state.runout[p.index];
    case Kind::offset:
      return state.offset[p.axis];
    case Kind::drift:
      return state.drift[p.axis];
    case Kind::phase_drift:
      return state.phase_drift[p.index];
    case Kind::mode_frequency:
      return state.dynamometer[p.axis][p.index].mode.natural_frequency;
    case Kind::mode_damping:
      return state.dynamometer[p.axis][p.index].mode.damping_ratio;
    case Kind::mode_gain:
      break;
  }
  return state.dynamometer[p.axis][p.index].gain;
}

double value_of(const RecordState& state, const Parameter& parameter) {
  return value_of(const_cast<RecordState&>(state), parameter);
}

Bounds bounds_of(const Parameter& p, const RecordState& start, const Record& record,
                 double runout_limit) {
  switch (p.kind) {
    case Kind::size_exponent:
      return {0.0, 0.9};
    case Kind::spindle_speed:
      return {0.9 * record.spindle_speed, 1.1 * record.spindle_speed};
    case Kind::runout:
      return {-runout_limit, runout_limit};
    case Kind::mode_frequency:
      return {0.5 * value_of(start, p), 2.0 * value_of(start, p)};
    case Kind::mode_damping:
      return {0.005, 0.9};
    default:
      return {-kUnbounded, kUnbounded};
  }
}

std::vector<Parameter> shared_parameters(const FitSettings& settings) {
  std::vector<Parameter> all;
  for (int i = 0; i < 6; ++i) {
    if (!settings.known[i].fixed) all.push_back({Kind::coefficient, i});
  }
  if (settings.model == Model::per_height) {
    for (int i = 0; i < 6; ++i) {
      if (!settings.known[i].fixed) all.push_back({Kind::coefficient, 6 + i});
    }
  }
  if (settings.model == Model::exponential) all.push_back({Kind::size_exponent});
  if (settings.runout == Estimated::shared) {
    for (int i = 0; i < 2; ++i) all.push_back({Kind::runout, i});
  }
  if (settings.spindle_speed == Estimated::shared) all.push_back({Kind::spindle_speed});
  if (settings.estimate_dynamometer) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_fitted(settings, axis)) continue;
      for (int i = 0; i < static_cast<int>(settings.dynamometer[axis].size()); ++i) {
        for (const Kind kind : {Kind::mode_frequency, Kind::mode_damping, Kind::mode_gain}) {
          all.push_back({kind, i, axis});
        }
      }
    }
  }
  return all;
}

std::vector<Parameter> own_parameters(const FitSettings& settings) {
  std::vector<Parameter> all;
  if (settings.phase != Estimated::no) all.push_back({Kind::phase});
  if (settings.spindle_speed == Estimated::per_record) all.push_back({Kind::spindle_speed});
  if (settings.runout == Estimated::per_record) {
    for (int i = 0; i < 2; ++i) all.push_back({Kind::runout, i});
  }
  for (const auto& [treated, kind] :
       {std::pair{settings.offset, Kind::offset}, std::pair{settings.drift, Kind::drift}}) {
    if (treated == Estimated::no) continue;
    for (int axis = 0; axis < 3; ++axis) {
      if (is_fitted(settings, axis)) all.push_back({kind, 0, axis});
    }
  }
  for (int i = 1; i + 1 < settings.phase_drift_knots; ++i) all.push_back({Kind::phase_drift, i});
  return all;
}

std::string name_of(const Parameter& p) {
  const auto mode = [&](const char* what) {
    return fmt::format("dynamometer_{}_{}_{}", kAxisNames[p.axis], p.index, what);
  };
  switch (p.kind) {
    case Kind::coefficient:
      return fmt::format("{}{}", kCoefficientNames[p.index % 6], p.index < 6 ? "" : "_slope");
    case Kind::size_exponent:
      return "size_exponent";
    case Kind::phase:
      return "phase";
    case Kind::spindle_speed:
      return "spindle_speed";
    case Kind::runout:
      return p.index == 0 ? "runout_cos" : "runout_sin";
    case Kind::offset:
      return fmt::format("offset_{}", kAxisNames[p.axis]);
    case Kind::drift:
      return fmt::format("drift_{}", kAxisNames[p.axis]);
    case Kind::phase_drift:
      return fmt::format("phase_drift_{}", p.index);
    case Kind::mode_frequency:
      return mode("frequency");
    case Kind::mode_damping:
      return mode("damping_ratio");
    case Kind::mode_gain:
      break;
  }
  return mode("gain");
}

std::string unit_of(const Parameter& p) {
  switch (p.kind) {
    case Kind::coefficient: {
      constexpr std::array<const char*, 4> units = {"N/mm2", "N/mm", "N/mm3", "N/mm2"};
      return units[p.index / 3];
    }
    case Kind::phase:
    case Kind::phase_drift:
      return "deg";
    case Kind::spindle_speed:
      return "rpm";
    case Kind::runout:
      return "mm";
    case Kind::offset:
      return "N";
    case Kind::drift:
      return "N/s";
    case Kind::mode_frequency:
      return "Hz";
    default:
      return "1";
  }
}

double factor_of(const Parameter& p) {
  switch (p.kind) {
    case Kind::phase:
    case Kind::phase_drift:
      return 180.0 / core::kPi;
    case Kind::spindle_speed:
      return 30.0 / core::kPi;
    case Kind::mode_frequency:
      return 0.5 / core::kPi;
    default:
      return 1.0;
  }
}

}  // namespace millstudy::identify
