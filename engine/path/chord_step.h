// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "path/curve.h"

namespace millstudy::path {

/// Where the tool stands: a place and what was evaluated there.
struct Stand {
  Cursor at;
  LocalPoint point;
  double speed_squared = 0.0;  ///< |dR/dt|^2 [mm^2]
};

inline Stand stand_at(const Curve& curve, Cursor at) {
  const LocalPoint point = curve.local(at);
  return {at, point, dot(point.first, point.first)};
}

/// One interpolation step.
struct ChordStep {
  Stand to;
  bool ended = false;     ///< no root is left: `to` is the end of the curve
  bool fallback = false;  ///< the bracketed search decided
  std::int64_t evaluations = 0;
};

struct ChordSettings {
  double chord = 0.0;      ///< V T [mm], > 0
  int max_iterations = 2;  ///< Newton updates N, >= 1
  double tolerance = 0.0;  ///< of V T
};

/// The chord from one stand to another [mm], from differences of local coordinates.
double chord_length(const Curve& curve, const Stand& from, const Stand& to);

/// Whether a last chord is a partial step: it is a full one if it misses the wanted chord by no
/// more than rounding could.
inline bool is_partial(double chord, double wanted) {
  constexpr double kSameChord = 1e-9;
  return chord < (1.0 - kSameChord) * wanted;
}

/// One step of the safeguarded Newton method, equations (P8) to (P11).
///
/// Plain Newton from the first-order start; its result is kept if it is proven to lie on the first
/// rise of the chord length. That costs nothing where the tangent cannot turn by 90 degrees within
/// the step (P11), one look at the chord polynomial where it might. Otherwise
/// first_root_step() takes over. An unconverged result of a small N is no reason to take over,
/// unless Newton did not come closer or is off by more than half a chord.
ChordStep newton_step(const Curve& curve, const Stand& from, const ChordSettings& settings);

/// One step by the bracketed search alone: first_chord_root(), then Newton kept in the bracket.
/// Meets the chord condition to rounding.
ChordStep first_root_step(const Curve& curve, const Stand& from, double chord);

}  // namespace millstudy::path
