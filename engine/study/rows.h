// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "force/figures.h"
#include "path/figures.h"
#include "study/case.h"
#include "study/kind.h"
#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::study {

/// The path variables, in the order of fill_path_row().
std::vector<sweep::Column> path_columns();
void fill_path_row(const path::PathFigures& figures, std::span<double> row);

/// What to measure of the force of a point, for these outputs.
force::FigureRequest figure_request(const Case& point, const Outputs& outputs);

/// The force variables, in the order of fill_force_row().
std::vector<sweep::Column> force_columns(const Outputs& outputs);
/// @param figures  of the shape that outputs ask for
/// @param removal_rate  volume that the cut takes per time, for the specific energy [mm3/s]
/// @param row      flutes that the point does not have, and a moment without a stick-out, are NaN
void fill_force_row(const Case& point, const Outputs& outputs, const force::ForceFigures& figures,
                    double removal_rate, std::span<double> row);

/// Interpolates the path of a case and measures it.
struct MeasuredPath {
  path::Interpolation interpolation;
  path::PathFigures figures;
};
MeasuredPath measured_path(const Case& point);

/// Appends the samples first .. first + count - 1 of a history to a trace.
void append_samples(const Case& point, std::int64_t first, std::int64_t count,
                    const force::ForceSamples& samples, sweep::Trace& trace);

/// Fills a trace with the record that [measurement] asks for. @throws core::CaseError
void fill_measured(const Case& point, sweep::Trace& trace);

}  // namespace millstudy::study
