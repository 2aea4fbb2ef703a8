// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace millstudy::io {

/// Writes a text to a file, complete or not at all.
///
/// @throws core::InputError if the file cannot be written there, core::ResourceError when the disk
/// is full
void write_text_file(const std::string& path, std::string_view text);

}  // namespace millstudy::io
