// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/hdf5.h"

/// Text in HDF5: variable-length UTF-8 is the form that xarray, ncdump and MATLAB all read as text.
namespace millstudy::io::hdf5 {

/// A one-dimensional variable of texts, shape (texts.size()).
Handle create_texts(hid_t parent, const std::string& name, std::span<const std::string> texts);

/// Elements begin .. begin + count - 1 of a variable of texts, of fixed or variable length.
std::vector<std::string> read_texts(hid_t dataset, const Shape& shape, std::int64_t begin,
                                    std::int64_t count);

/// A text attribute of fixed or variable length, scalar or of one element.
/// @throws Error also if it is none, or larger than 64 MiB
std::string read_text_attribute(hid_t attribute);

}  // namespace millstudy::io::hdf5
