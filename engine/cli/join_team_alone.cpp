// SPDX-License-Identifier: MIT
// Of a program that is built without MPI.
#include "cli/join_team.h"

namespace millstudy::cli {

std::unique_ptr<sweep::Team> join_team() {
  return std::make_unique<sweep::Alone>();
}

}  // namespace millstudy::cli
