// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "sweep/team.h"

namespace millstudy::cli {

/// The processes that mpirun started together with this one; this one alone in a program
/// without MPI, and where nobody started more.
std::unique_ptr<sweep::Team> join_team();

}  // namespace millstudy::cli
