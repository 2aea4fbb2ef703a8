// SPDX-License-Identifier: MIT
#include "path/parameter_step.h"

#include <cmath>

namespace millstudy::path {
namespace {

/// R' = 0 to rounding: a doubled control point or a cusp.
bool rests(const Curve& curve, const Stand& from) {
  return norm(from.point.first.xyz()) <= curve.spans()[from.at.span].rest;
}

/// The step of length dt (in t of the span of `from`), evaluated.
ChordStep step_by(const Curve& curve, const Stand& from, double dt, double chord) {
  if (!(dt > 0.0) || !std::isfinite(dt)) return first_root_step(curve, from, chord);
  ChordStep step;
  const Cursor at = curve.settle({from.at.span, from.at.t + dt});
  step.to = stand_at(curve, at);
  step.evaluations = 1;
  step.ended = curve.at_end(at) && is_partial(chord_length(curve, from, step.to), chord);
  return step;
}

}  // namespace

ChordStep taylor1_step(const Curve& curve, const Stand& from, double chord) {
  if (rests(curve, from)) return first_root_step(curve, from, chord);
  return step_by(curve, from, chord / norm(from.point.first.xyz()), chord);  // (P15)
}

ChordStep taylor2_step(const Curve& curve, const Stand& from, double chord) {
  if (rests(curve, from)) return first_root_step(curve, from, chord);
  const Vec3 first = from.point.first.xyz();
  const double square = dot(first, first);
  const double bend = dot(first, curve.local_second(from.at, from.point));
  // (P16)
  const double dt = chord / std::sqrt(square) - 0.5 * chord * chord * bend / (square * square);
  return step_by(curve, from, dt, chord);
}

ChordStep predictor_corrector_step(const Curve& curve, const Stand& from,
                                   const StepHistory& history, const ChordSettings& settings) {
  const double chord = settings.chord;
  double extrapolated = 2.0 * history.last - history.before_last;
  // A straight line through two steps says nothing where they differ by more than a factor.
  if (history.before_last <= 0.0 || !(extrapolated > 0.5 * history.last) ||
      extrapolated > 2.0 * history.last) {
    extrapolated = history.last;
  }
  const double scale = curve.spans()[from.at.span].inverse_half;
  double dt = extrapolated * scale;
  std::int64_t evaluations = 0;
  for (int corrections = 0;; ++corrections) {
    ChordStep step = step_by(curve, from, dt, chord);
    step.evaluations += evaluations;
    evaluations = step.evaluations;
    if (step.fallback || corrections == settings.max_iterations) return step;
    const double got = chord_length(curve, from, step.to);
    if (std::abs(chord - got) < settings.tolerance * chord) return step;
    if (curve.at_end(step.to.at)) {
      if (step.ended) return step;
      dt =
          (curve.end() - curve.parameter(from.at)) * scale;  // what was stepped, not what was asked
    }
    dt *= chord / got;  // (P17)
  }
}

}  // namespace millstudy::path
