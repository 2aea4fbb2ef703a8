// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "cutter/cutter.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "force/slice.h"

namespace millstudy::force {

/// Rows x, y, z, torque; chip columns Ktc Krc Kac, edge columns Kte Kre Kae; see Basis.
using ForceBasis = Basis<double>;

/// Force on the tool at one angle, as a linear function of feed and the six coefficients: the
/// readable reference, and the design matrix of a fit.
///
/// (F7): (F3) summed over all teeth. Rule::exact: flat by the closed form (F9), ball by
/// Gauss-Legendre in kappa (F10). Measured against adaptive quadrature: below 2e-13 of the peak,
/// for helix angles from 0 to 60 deg of both hands. Rule::discs: (F12).
///
/// @param phi  immersion angle of the tip of flute 0 [rad], any
/// @return shape (4, 3) twice; zero when no tooth cuts
/// Throws core::InputError for a cutter, engagement or rule out of range.
ForceBasis force_basis(const cutter::Cutter& cutter, const Engagement& engagement,
                       const EdgeRule& edge_rule, double phi);

/// Forces x, y, z [N] and torque [N mm] of a basis; shape (4).
/// @param feed_per_tooth  [mm], >= 0
std::array<double, kRows> evaluate(const ForceBasis& basis, const Coefficients& coefficients,
                                   double feed_per_tooth);

}  // namespace millstudy::force
