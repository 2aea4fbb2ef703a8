// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "core/value.h"

namespace millstudy::io {

/// The bytes of a regular file of at most 8 MiB.
///
/// @throws core::InputError if it is none or cannot be read
std::string read_text(const std::string& path);

/// The TOML 1.0 file as a tree; tables in the order of the file, every value with file and line.
///
/// inf and nan are read as they are: whoever knows the range of a key refuses them. Dates and times
/// are not supported.
///
/// @param path  a regular file of at most 8 MiB
/// @throws core::InputError if it cannot be read, is not UTF-8 or not TOML (a syntax error is
///         reported alone), holds a date or time, or nests values deeper than 64 or more than 16
///         parts in a dotted key
core::Value read_toml(const std::string& path);

/// The same of a text; name stands for the file in messages and places.
core::Value parse_toml(std::string_view text, const std::string& name);

}  // namespace millstudy::io
