// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace millstudy::io {

/// A variable of a MATLAB or HDF5 file as it is asked for: all of it, or a column or row of a
/// matrix.
struct VariableName {
  std::string name;
  struct Slice {
    bool column = true;      ///< of the matrix as its program shows it; otherwise a row
    std::int64_t index = 0;  ///< from 0
  };
  std::optional<Slice> slice;
  bool matlab = false;  ///< round brackets: HDF5 has the dimensions in reverse order
};

/// Reads "data", "data(:,2)" and "data(2,:)" as MATLAB counts, from 1, "data[:,1]" and "data[1,:]"
/// as Python does, from 0. Anything else is a name as it is.
VariableName parse_variable(const std::string& text);

}  // namespace millstudy::io
