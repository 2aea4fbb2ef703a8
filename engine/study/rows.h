// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "force/statistics.h"
#include "path/figures.h"
#include "study/case.h"
#include "study/kind.h"
#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::study {

/// The path variables, in the order of fill_path_row().
std::vector<sweep::Column> path_columns();
void fill_path_row(const path::PathFigures& figures, std::span<double> row);

/// What one flute does.
struct FluteFigures {
  double chip_thickness_max = 0.0;  ///< [mm]
  double load_share = 0.0;          ///< its part of the mean torque [1]
};

/// What is measured of the force of one point; the rest of a row follows from the case.
struct ForceFigures {
  force::ForceStatistics statistics = {};
  double chip_thickness_max = 0.0;               ///< [mm]
  double cutting_time_fraction = 0.0;            ///< part of the samples in which a flute cuts [1]
  double bending_moment_max = 0.0;               ///< at the holder [N mm]
  std::array<std::vector<double>, 4> harmonics;  ///< of x, y, z [N] and torque [N mm], each from
                                                 ///< the first; shape (4, harmonics)
  std::vector<FluteFigures> flutes;              ///< shape (flutes of the point), or empty
};

/// Figures of the shape that outputs ask for, all zero.
ForceFigures no_figures(const Case& point, const Outputs& outputs);

/// The force variables, in the order of fill_force_row().
std::vector<sweep::Column> force_columns(const Outputs& outputs);
/// @param figures  of the shape that outputs ask for
/// @param row      flutes that the point does not have, and a moment without a stick-out, are NaN
void fill_force_row(const Case& point, const Outputs& outputs, const ForceFigures& figures,
                    std::span<double> row);

/// Interpolates the path of a case and measures it.
struct MeasuredPath {
  path::Interpolation interpolation;
  path::PathFigures figures;
};
MeasuredPath measured_path(const Case& point);

/// Appends the samples first .. first + count - 1 of a history to a trace.
void append_samples(const Case& point, std::int64_t first, std::int64_t count,
                    const force::ForceSamples& samples, sweep::Trace& trace);

}  // namespace millstudy::study
