// SPDX-License-Identifier: MIT
#pragma once

#include "study/kind.h"

namespace millstudy::study {

const Kind& path_kind();        // kind_path.cpp
const Kind& force_kind();       // kind_force.cpp
const Kind& path_force_kind();  // kind_path_force.cpp
const Kind& stability_kind();   // kind_stability.cpp
const Kind& finish_kind();      // kind_finish.cpp

}  // namespace millstudy::study
