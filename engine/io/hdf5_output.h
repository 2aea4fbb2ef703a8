// SPDX-License-Identifier: MIT
#pragma once

#include "io/hdf5.h"

namespace millstudy::io::hdf5 {

/// An open file that HDF5 writes, and what went wrong with it: errno of the first failure, or 0.
///
/// Failures while identifiers are closed reach nobody else, so `error` decides at the end.
struct Output {
  int fd = -1;
  int error = 0;
};

/// A new HDF5 file in the 1.8 format (what MATLAB of ten years ago reads) that keeps the order in
/// which variables and attributes were made and takes attributes of any size. Empties what is
/// there.
///
/// Written through a driver of ours, because HDF5 1.10 crashes at exit when a file cannot be closed
/// (measured: a limit on file size). It writes behind HDF5's back (write_behind.h), so a failure is
/// seen later, at the latest by who closed the file. After it, writing does nothing and succeeds,
/// so that closing always works.
///
/// @param output  open for reading and writing; must outlive the file; not closed here
Handle create_file(Output& output);

}  // namespace millstudy::io::hdf5
