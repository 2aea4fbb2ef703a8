// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sweep/layout.h"

namespace millstudy::cli {

/// Attributes that say which program made a result, where and when.
std::vector<sweep::Attribute> provenance(int threads);

/// "process 123 on host"
std::string this_process();

}  // namespace millstudy::cli
