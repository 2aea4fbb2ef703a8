// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::io {

/// Bytes of the result file of a study, from some of its points: a file of these in memory, with
/// what it holds of each variable scaled to all points.
///
/// Exact but for what finish() adds if all points are given. Of others, whatever a variable has in
/// common with its neighbours shrinks as it does in the given blocks: points that are far from each
/// other hide that a variable repeats along an axis; regions without values count in full. Takes
/// the memory of the coordinates of a sampled design once more.
///
/// @param measured       blocks of the layout, in any order; not empty
/// @param trace_samples  samples of all time histories of the study together; 0 without traces
/// @throws core::ResourceError if there is no memory for the file
/// Measured: 0.97 to 1.04 times the results of the ready-made studies.
double expected_result_bytes(const sweep::Layout& layout, std::vector<sweep::Block> measured,
                             double trace_samples);

}  // namespace millstudy::io
