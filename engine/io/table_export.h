// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace millstudy::io {

/// Writes a result as a table with one row per point: coordinates, variables, status, failure.
///
/// `.csv`: a header line with names and units ("force_x_mean [N]", dimensionless ones bare), then
/// the numbers in the shortest form that reads back to the same bits; NaN is empty. `.npy`: a
/// NumPy structured array, shape (points), float64 and fixed-width Unicode fields by name.
/// Time histories are not exported. Memory does not grow with the points; the output appears
/// complete or not at all.
///
/// @throws core::InputError for another suffix or an input that is no result, core::ResourceError
/// when
///         the disk is full
void export_table(const std::string& result_path, const std::string& output_path);

}  // namespace millstudy::io
