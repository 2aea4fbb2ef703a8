// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/value.h"
#include "study/faults.h"

namespace millstudy::study {

/// Words for people that every file beside a study may have.
inline constexpr std::array<std::string_view, 5> kFileText = {"name", "source", "units", "licence",
                                                              "description"};

bool is_file_text(std::string_view name);

/// The numbers of a list in such a file; what is wrong is a fault at its place.
std::vector<double> number_list(const core::Value& value, std::string_view name, Faults& faults);

}  // namespace millstudy::study
