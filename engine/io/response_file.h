// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/value.h"

namespace millstudy::io {

/// Whether a name ends as a file of measurements does: .frf, .csv, .tsv, .txt, .dat, .h5, .hdf5,
/// .mat, .lvm or .tdms, in letters of either case.
bool is_response_file(const std::string& path);

/// A measured frequency response in any format of read_trace_file(), as a tree: points = [[Hz,
/// real, imaginary], ...], each with its line, and unit, which is m/N where the file says none.
///
/// The columns are found by their names (freq, real, imag); three without names are taken in that
/// order, as a CutPro .frf file has them. Frequencies in Hz, kHz or rad/s.
/// @throws core::InputError for what read_trace_file() finds, columns that are not there or not
///         equally long, amplitude and phase, a frequency in another unit, parts in two units
core::Value read_response_file(const std::string& path);

}  // namespace millstudy::io
