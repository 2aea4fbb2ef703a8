// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "cutter/cutter.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "force/slice.h"
#include "force/variation.h"

namespace millstudy::force {

/// Rows x, y, z, torque; chip columns Ktc Krc Kac, edge columns Kte Kre Kae, plunge columns; see
/// Basis.
using ForceBasis = Basis<double>;

/// Force on the tool at one angle, as a linear function of feed and the six coefficients: the
/// readable reference, and the design matrix of a fit.
///
/// (F7): (F3) summed over all teeth. Rule::exact: cylinders by the closed form (F9), other
/// envelopes by Gauss-Legendre (F10). Measured against adaptive quadrature: below 2e-13 of the
/// peak, for helix angles from 0 to 60 deg of both hands. Rule::discs: (F12).
///
/// Of cutters without runout and coefficients that do not depend on the chip: what else there is
/// makes the force nonlinear, see NonlinearForce.
///
/// @param phi  immersion angle of the tip of flute 0 [rad], any
/// @return shape (4, 3) three times; zero when no tooth cuts
/// Throws core::InputError for a cutter, engagement or rule out of range.
ForceBasis force_basis(const cutter::Cutter& cutter, const Engagement& engagement,
                       const EdgeRule& edge_rule, double phi, const Variation& variation = {});

/// Forces x, y, z [N] and torque [N mm] of a basis; shape (4).
std::array<double, kRows> evaluate(const ForceBasis& basis, const Coefficients& coefficients,
                                   const Feed& feed);

}  // namespace millstudy::force
