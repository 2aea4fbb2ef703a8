// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace millstudy::io {

/// What to write instead, for the slips of people who come from spreadsheets, MATLAB or Python:
/// "0,5", "[0:2:50]", "True", "12.0 mm", a text without quotes.
///
/// @param toml         the text that the parser refused
/// @param line         the line that it names, from 1
/// @param description  what it says
/// @return one line; the description, where the slip is none of the known ones
std::string hint(std::string_view toml, int line, std::string_view description);

}  // namespace millstudy::io
