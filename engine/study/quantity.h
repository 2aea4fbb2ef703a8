// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "study/kind.h"

namespace millstudy::study {

/// What a limit may be put on: a numeric key of the kind by its dotted path, or a quantity derived
/// from the case (feed_per_tooth_mm, cutting_speed_m_per_min, ...), in the unit of its name. The
/// derived name wins. Empty for an unknown name.
std::function<std::optional<double>(const Case&)> quantity_named(std::string_view name,
                                                                 const Kind& kind);

/// The derived quantities that cases of the kind have.
std::vector<std::string_view> quantity_names(const Kind& kind);

}  // namespace millstudy::study
