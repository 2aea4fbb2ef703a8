// SPDX-License-Identifier: MIT
#pragma once

#include "sweep/block.h"

namespace millstudy::sweep {

/// Status, values, reason and trace of point k of a block become those of point i of another, which
/// has the same columns. What is long is moved. Of a block without values there are none.
void copy_point(Block& from, std::int64_t k, Block& to, std::int64_t i);

}  // namespace millstudy::sweep
