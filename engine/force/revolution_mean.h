// SPDX-License-Identifier: MIT
#pragma once

#include "force/force_basis.h"

namespace millstudy::force {

/// Mean force over a revolution as a linear function of feed and the six coefficients, (F32): the
/// design matrix of Budak, Altintas and Armarego's average method, for any cutter and engagement.
///
/// Of a cutter without runout. With it, as long as every tooth cuts, chip moves from tooth to tooth
/// and the chip terms of the mean stay what they are.
///
/// Slot formulas of a flat end mill to 1e-14; sums of force_basis() over 20 000 angles agree to
/// 1e-4, which is what these leave where teeth enter and leave (measured, 40 random cutters).
/// @return shape (4, 3) three times, per revolution; see ForceBasis
/// Throws core::InputError for a cutter or engagement out of range.
ForceBasis revolution_mean(const cutter::Cutter& cutter, const Engagement& engagement);

}  // namespace millstudy::force
