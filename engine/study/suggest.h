// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace millstudy::study {

/// The nearest of the known words, or "" where none is near.
///
/// Near is an edit distance (Levenshtein) of at most a third of the word's length.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

/// "; did you mean X?" for the nearest of the known words, or "".
std::string suggestion(std::string_view word, std::span<const std::string_view> known);

}  // namespace millstudy::study
