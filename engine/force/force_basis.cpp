// SPDX-License-Identifier: MIT
#include "force/force_basis.h"

#include <cmath>

#include "force/discs.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// (F12): the discs of one tooth whose middle is in the material.
void add_discs(ForceBasis& basis, const cutter::Cutter& cutter, const Engagement& engagement,
               int discs, double tip_angle) {
  const double width = engagement.exit_angle - engagement.entry_angle;
  for (int i = 0; i < discs; ++i) {
    const Disc disc = disc_at(cutter, engagement.axial_depth, discs, i);
    const double phi = tip_angle - disc.lag_angle;
    const double past = angle_past_first_limit(cutter, engagement, phi);
    if (!(past > 0.0 && past <= width)) continue;
    const double sin_phi = std::sin(phi);
    const Matrix43<double> axes =
        edge_axes(sin_phi, std::cos(phi), disc.sin_kappa, disc.cos_kappa, disc.radius);
    add_slice(basis, axes, sin_phi * disc.height, disc.edge_length);
  }
}

}  // namespace

ForceBasis force_basis(const cutter::Cutter& cutter, const Engagement& engagement,
                       const EdgeRule& edge_rule, double phi) {
  cutter::check(cutter);
  check(cutter, engagement);
  check(edge_rule);
  ForceBasis basis;
  for (int tooth = 0; tooth < cutter.flutes; ++tooth) {
    const double tip_angle = phi + tooth * cutter::pitch_angle(cutter);  // (F5) at z = 0
    if (edge_rule.rule == Rule::discs) {
      add_discs(basis, cutter, engagement, edge_rule.discs, tip_angle);
      continue;
    }
    for_each_engaged_interval(cutter, engagement, tip_angle, [&](double z1, double z2) {
      add_edge(basis, cutter, tip_angle, z1, z2);
    });
  }
  return basis;
}

std::array<double, kRows> evaluate(const ForceBasis& basis, const Coefficients& coefficients,
                                   double feed_per_tooth) {
  return apply(basis, loads(coefficients, feed_per_tooth));
}

}  // namespace millstudy::force
