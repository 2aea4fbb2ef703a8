// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "force/history.h"
#include "path/figures.h"
#include "study/case.h"
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

/// Bytes of values one after another: the key under which shared work is kept.
template <class... Values>
std::string share_key(const Values&... values) {
  std::string key;
  (key.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
  return key;
}

}  // namespace millstudy::study
