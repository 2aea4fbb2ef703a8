// SPDX-License-Identifier: MIT
#pragma once

#include "path/curve.h"
#include "path/interpolate.h"

namespace millstudy::path {

/// What an interpolated path is judged by. The fluctuation (P19) is over full steps only, and zero
/// where there is none.
struct PathFigures {
  double feed_fluctuation_max = 0.0;  ///< max |delta| [percent]
  double feed_fluctuation_rms = 0.0;  ///< sqrt(mean delta^2) [percent]
  double feed_fluctuation_l2 = 0.0;   ///< sqrt(sum delta^2) [percent]
  double steps = 0.0;                 ///< full steps
  double curve_evaluations = 0.0;
  double fallback_steps = 0.0;
  double path_length = 0.0;      ///< arc length of the curve [mm]
  double path_time = 0.0;        ///< (full + partial) T [s]
  double chord_error_max = 0.0;  ///< (P20), largest distance of the curve from its chord [mm]
};

/// The figures of a path that interpolate() made from the same curve.
///
/// Chords are differences of local coordinates, so a curve far from the origin has the figures of
/// the same curve at the origin. Accuracy: fluctuation to the rounding of u (|R'| times the spacing
/// of doubles at u, over V T); chord_error_max 1e-3 relative, measured against a scan of 2000
/// places a step. Evaluations made here are not counted.
PathFigures path_figures(const Curve& curve, const Interpolation& path);

}  // namespace millstudy::path
