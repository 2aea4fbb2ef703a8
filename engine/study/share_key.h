// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <span>
#include <string>

#include "study/key.h"

namespace millstudy::study {

/// What two points must have in common to share work: every key of these sections, and these
/// quantities. A new key of a section is part of it without further ado.
///
/// @return bytes; equal for points that agree in all of it
std::string share_key(std::initializer_list<std::span<const Key>> sections, const Case& point,
                      std::initializer_list<double> quantities);

}  // namespace millstudy::study
