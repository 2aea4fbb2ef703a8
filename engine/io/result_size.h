// SPDX-License-Identifier: MIT
#pragma once

#include "sweep/layout.h"

namespace millstudy::io {

/// Most bytes that the result file of a study can take: no chunk shrinks, the last chunk of every
/// variable is padded.
///
/// @param trace_samples  samples of all time histories together; 0 without traces
/// Measured: 1.3 to 1.7 times the results of the ready-made studies without time histories.
double largest_result_bytes(const sweep::Layout& layout, double trace_samples);

}  // namespace millstudy::io
