// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "path/curve.h"

namespace millstudy::path {

/// How the next parameter is found; see theory.md.
enum class Method {
  uniform_parameter,    ///< equal parameter steps, whatever the feed
  taylor1,              ///< first-order Taylor step (P15)
  taylor2,              ///< second-order Taylor step (P16)
  predictor_corrector,  ///< extrapolated step, scaled by chord wanted / chord got (P17)
  arc_length_table,     ///< arc length tabulated, interpolated backwards (P18)
  newton                ///< safeguarded Newton on the chord condition (P8) to (P11)
};

struct InterpolationSettings {
  Method method = Method::newton;
  double feed_rate = 0.0;  ///< V [mm/s], > 0
  double period = 0.0;     ///< T [s], > 0
  int max_iterations = 2;  ///< N of newton and predictor_corrector, 1 to 1000
  double tolerance = 0.0;  ///< fraction of V T below which they stop before N; 0 is never
  int steps = 1000;        ///< of uniform_parameter, 1 to kMostSteps
  int table_size = 1000;   ///< intervals of arc_length_table, 1 to kMostSteps
};

inline constexpr int kMostSteps = 10000000;

/// A curve cut into steps of one interpolation period each.
struct Interpolation {
  std::vector<Vec3> points;        ///< start to end [mm], shape (periods + 1)
  std::vector<double> parameters;  ///< strictly increasing, shape (periods + 1)
  std::int64_t full_steps = 0;
  bool partial = false;  ///< the last period is a partial step to the end point
  std::int64_t curve_evaluations = 0;
  std::int64_t fallback_steps = 0;  ///< steps decided by the bracketed search
  double period = 0.0;              ///< T [s]
  double wanted_chord = 0.0;        ///< V T [mm]
};

/// Cuts a curve into steps with |R(u+) - R(u)| = V T, as far as the method meets it.
///
/// newton meets it to 1e-11 of V T plus the rounding of u (|R'| times half the spacing of doubles
/// at u) once N is large enough, on the first forward root at every step. The other methods
/// propagate their own error. Where a Taylor step has no length (R' = 0) or goes backward, and
/// where a predictor gets no chord, the bracketed search takes that step.
///
/// A rest shorter than 1e-10 of the last step, or than the rounding of u over all steps, is joined
/// to it. If a step would pass the end of the
/// curve it ends there; it is the partial step if its chord is shorter than V T.
///
/// newton with N updates costs N + 1 evaluations a step, predictor_corrector as many, the others
/// one (arc_length_table also those that fill its table).
///
/// @throws core::InputError  settings out of range
/// @throws core::CaseError   more than kMostSteps steps, foreseen from length / (V T) or met
Interpolation interpolate(const Curve& curve, const InterpolationSettings& settings);

}  // namespace millstudy::path
