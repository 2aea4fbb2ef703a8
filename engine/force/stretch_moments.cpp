// SPDX-License-Identifier: MIT
#include "force/stretch_moments.h"

#include <cmath>

namespace millstudy::force {

void StretchMoments::add(const EdgeNode& node, double factor, double cos_lag, double sin_lag) {
  const double width = factor * node.width * node.sin_kappa;
  const std::array<double, 3> part = {1.0, node.sin_kappa, node.cos_kappa};
  for (int i = 0; i < 3; ++i) {
    const double w = width * part[i];
    chip[i].cc += w * cos_lag * cos_lag;
    chip[i].cs += w * cos_lag * sin_lag;
    chip[i].ss += w * sin_lag * sin_lag;
    edge[i].c += factor * node.length * part[i] * cos_lag;
    edge[i].s += factor * node.length * part[i] * sin_lag;
  }
  for (int i = 0; i < 2; ++i) {
    chip_up[i].c += width * part[2 - i] * cos_lag;
    chip_up[i].s += width * part[2 - i] * sin_lag;
    edge_up[i] += factor * node.length * part[2 - i];
  }
}

MomentPair moments_of(const CuttingEdges& edges, const EdgePiece& piece, double helix_tangent,
                      double z1, double z2, bool with_slopes) {
  MomentPair pair{};
  edges.for_each_node(piece, helix_tangent, z1, z2, [&](const EdgeNode& node) {
    const double lag = helix_tangent * node.lag;
    const double c = std::cos(lag), s = std::sin(lag);
    pair[0].add(node, 1.0, c, s);
    if (with_slopes) pair[1].add(node, node.z, c, s);
  });
  return pair;
}

// With phi = tip - psi: cos(phi) = C c + S s and sin(phi) = S c - C s. Rows are those of (F4).

UnitForces chip_forces(const StretchMoments& m, double a, double b, double cos_tip,
                       double sin_tip) {
  UnitForces out{};
  for (int i = 0; i < 3; ++i) {
    const double u = a * m.chip[i].cc + b * m.chip[i].cs;
    const double v = a * m.chip[i].cs + b * m.chip[i].ss;
    const double cos_sum = cos_tip * u + sin_tip * v;
    const double sin_sum = sin_tip * u - cos_tip * v;
    if (i == 0) {
      out[0] = {-cos_sum, sin_sum, 0.0};
    } else {
      const double up = a * m.chip_up[i - 1].c + b * m.chip_up[i - 1].s;
      out[i] = {-sin_sum, -cos_sum, i == 1 ? up : -up};
    }
  }
  return out;
}

UnitForces edge_forces(const StretchMoments& m, double cos_tip, double sin_tip) {
  UnitForces out{};
  for (int i = 0; i < 3; ++i) {
    const double cos_sum = cos_tip * m.edge[i].c + sin_tip * m.edge[i].s;
    const double sin_sum = sin_tip * m.edge[i].c - cos_tip * m.edge[i].s;
    if (i == 0) {
      out[0] = {-cos_sum, sin_sum, 0.0};
    } else {
      out[i] = {-sin_sum, -cos_sum, i == 1 ? m.edge_up[0] : -m.edge_up[1]};
    }
  }
  return out;
}

}  // namespace millstudy::force
