// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "force/statistics.h"
#include "path/figures.h"
#include "study/case.h"
#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::study {

/// The path variables, in the order of fill_path_row().
std::vector<sweep::Column> path_columns();
void fill_path_row(const path::PathFigures& figures, std::span<double> row);

/// The force variables, in the order of fill_force_row().
std::vector<sweep::Column> force_columns();
/// @param chip_thickness_max  [mm]
void fill_force_row(const Case& point, const force::ForceStatistics& force,
                    double chip_thickness_max, std::span<double> row);

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
