// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "dynamics/dynamometer.h"
#include "force/sensitivity.h"
#include "identify/fit.h"

/// The numbers that a fit moves. Private to identify/.
namespace millstudy::identify {

/// Everything that the predicted forces of one record depend on besides the cut itself.
struct RecordState {
  force::FittedCoefficients coefficients;
  std::array<std::vector<dynamics::DynamometerMode>, 3> dynamometer;
  double phase = 0.0;               ///< immersion angle of flute 0's tip at the middle [rad]
  double spindle_speed = 0.0;       ///< there [rad/s]
  std::array<double, 2> runout{};   ///< offset times cos and sin of its angle [mm]
  std::array<double, 3> offset{};   ///< at the middle [N]
  std::array<double, 3> drift{};    ///< [N/s]
  std::vector<double> phase_drift;  ///< coefficients of a cubic spline, the outer two zero [rad]
};

/// One estimated number of a RecordState.
struct Parameter {
  enum class Kind {
    coefficient,  ///< index 0 .. 11, of FittedCoefficients
    size_exponent,
    phase,
    spindle_speed,
    runout,          ///< index 0, 1
    offset,          ///< axis
    drift,           ///< axis
    phase_drift,     ///< index of the spline's coefficient
    mode_frequency,  ///< axis, index of the mode
    mode_damping,
    mode_gain,
  };
  Kind kind;
  int index = 0;
  int axis = 0;
};

/// The number itself.
double& value_of(RecordState& state, const Parameter& parameter);
double value_of(const RecordState& state, const Parameter& parameter);

/// What a parameter may be.
struct Bounds {
  double low;
  double high;
};

/// Limits that keep the model meaningful, around the state in which the search begins.
Bounds bounds_of(const Parameter& parameter, const RecordState& start, const Record& record,
                 double runout_limit);

/// Those that all records have in common, coefficients first.
std::vector<Parameter> shared_parameters(const FitSettings& settings);

/// Those of each record, alike for all.
std::vector<Parameter> own_parameters(const FitSettings& settings);

/// "Ktc", "Kae_slope", "size_exponent", "phase", "dynamometer_x_0_frequency".
std::string name_of(const Parameter& parameter);
/// As results write it: "N/mm2". Values in it are those of value_of() times factor_of().
std::string unit_of(const Parameter& parameter);
double factor_of(const Parameter& parameter);

}  // namespace millstudy::identify
