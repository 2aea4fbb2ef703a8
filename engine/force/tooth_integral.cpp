// SPDX-License-Identifier: MIT
#include "force/tooth_integral.h"

#include "core/quadrature.h"
#include "core/units.h"
#include "cutter/envelope.h"

namespace millstudy::force {
namespace {

/// (F9): the cylinder, from the corrected (26) of the paper in midpoint-and-sinc form.
void add_cylinder(ForceBasis& basis, const cutter::Cutter& cutter, double tip_angle, double z1,
                  double z2) {
  const double height = z2 - z1;
  const double rate = cutter::lag_rate(cutter);
  const double turn = rate * height;
  const double middle = tip_angle - rate * (0.5 * (z1 + z2));
  // Integrals over z of sin(phi), cos(phi), sin^2(phi), sin(phi) cos(phi): (F8).
  const double once = height * sinc(0.5 * turn);
  const double twice = height * sinc(turn);
  const double s = once * std::sin(middle);
  const double c = once * std::cos(middle);
  const double ss = 0.5 * (height - twice * std::cos(2.0 * middle));
  const double sc = 0.5 * twice * std::sin(2.0 * middle);
  const double r = cutter::radius(cutter);
  const double length = cutter::edge_length_rate(cutter);
  const Matrix43<double> chip = {{{-sc, -ss, 0.0}, {ss, -sc, 0.0}, {0.0, 0.0, -s}, {r * s, 0, 0}}};
  const Matrix43<double> edge = {
      {{-c, -s, 0.0}, {s, -c, 0.0}, {0.0, 0.0, -height}, {r * height, 0.0, 0.0}}};
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      basis.chip[row][column] += chip[row][column];
      basis.edge[row][column] += length * edge[row][column];
    }
  }
}

/// (F10): the ball, in kappa. The integrand has branch points at sin^2(kappa) = +-i / tan(helix),
/// which come closer to the axis as the helix steepens: so the number of nodes follows the span
/// times 1 + tan(helix). Up to the 20 nodes of the longest panel it is three more than rounding
/// needs, measured for helix angles of 0 to 80 deg.
void add_ball(ForceBasis& basis, const cutter::Cutter& cutter, double tip_angle, double kappa1,
              double kappa2) {
  const double radius = cutter::radius(cutter);
  const double rate = cutter::lag_rate(cutter);
  const double slope = std::tan(cutter.helix_angle);
  const double span = (kappa2 - kappa1) * (1.0 + std::abs(slope));
  const int panels = 1 + static_cast<int>(span / 3.0);
  const core::GaussRule& rule = core::gauss_legendre(8 + static_cast<int>(4.0 * span / panels));
  const double half = 0.5 * (kappa2 - kappa1) / panels;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = kappa1 + (2 * panel + 1) * half;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double kappa = middle + half * rule.nodes[i];
      const double sin_kappa = std::sin(kappa);
      const double cos_kappa = std::cos(kappa);
      const double z = radius * sin_kappa * sin_kappa / (1.0 + cos_kappa);
      const double phi = tip_angle - rate * z;
      const double sin_phi = std::sin(phi);
      const double step = half * rule.weights[i] * radius;  // R dkappa = db
      const Matrix43<double> axes =
          edge_axes(sin_phi, std::cos(phi), sin_kappa, cos_kappa, radius * sin_kappa);
      add_slice(basis, axes, sin_phi * sin_kappa * step,
                cutter::ball_edge_per_width(slope, sin_kappa) * step);  // (C12)
    }
  }
}

/// The edge over heights below curved_height().
void add_curved(ForceBasis& basis, const cutter::Cutter& cutter, double tip_angle, double z1,
                double z2) {
  switch (cutter.shape) {
    case cutter::Shape::flat:
      return;  // it has no curved part
    case cutter::Shape::ball:
      add_ball(basis, cutter, tip_angle, cutter::envelope(cutter, z1).kappa,
               cutter::envelope(cutter, z2).kappa);
      return;
  }
}

}  // namespace

double angle_past_first_limit(const cutter::Cutter& cutter, const Engagement& engagement,
                              double tip_angle) {
  constexpr double kTurn = 2.0 * core::kPi;
  const double ahead =
      hand(cutter) > 0.0 ? tip_angle - engagement.entry_angle : engagement.exit_angle - tip_angle;
  const double rest = std::fmod(ahead, kTurn);
  const double past = rest < 0.0 ? rest + kTurn : rest;
  if (past < kAngleSnap || past > kTurn - kAngleSnap) return 0.0;
  const double width = engagement.exit_angle - engagement.entry_angle;
  return std::abs(past - width) < kAngleSnap ? width : past;
}

void add_edge(ForceBasis& basis, const cutter::Cutter& cutter, double tip_angle, double z1,
              double z2) {
  const double top = cutter::curved_height(cutter);
  if (z1 < top) add_curved(basis, cutter, tip_angle, z1, std::min(z2, top));
  if (z2 > top) add_cylinder(basis, cutter, tip_angle, std::max(z1, top), z2);
}

}  // namespace millstudy::force
