// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "unit/force/reference_integral.h"

namespace millstudy::force::reference {
namespace {

constexpr double kTurn = 2.0 * M_PI;

double quantity(const OrthogonalQuantity& q, double rake, double h) {
  return q.constant + q.per_rake * rake + q.per_chip * h;
}

double table_at(const std::vector<double>& at, const std::vector<double>& values, double z) {
  if (z <= at.front()) return values.front();
  for (std::size_t i = 1; i < at.size(); ++i) {
    if (z > at[i]) continue;
    return (values[i - 1] * (at[i] - z) + values[i] * (z - at[i - 1])) / (at[i] - at[i - 1]);
  }
  return values.back();
}

double runout_radius(const Tool& tool, double position, double z) {
  const cutter::Runout& r = tool.runout();
  return r.offset * std::cos(position - r.angle) +
         z * std::tan(r.tilt) * std::cos(position - r.tilt_angle);
}

}  // namespace

/// Ktc Krc Kac Kte Kre Kae at a height under a chip.
std::array<double, 6> coefficients_at(const Cut& cut, double z, double h, double tan_i) {
  const Coefficients& c = cut.coefficients;
  std::array<double, 6> k = {c.Ktc, c.Krc, c.Kac, c.Kte, c.Kre, c.Kae};
  if (cut.variation.height) {
    const HeightFactors& f = *cut.variation.height;
    for (int q = 0; q < 6; ++q) {
      if (!f.table[q].empty()) k[q] *= table_at(f.heights, f.table[q], z);
      double polynomial = 1.0, power = z;
      for (const double term : f.polynomial[q]) {
        polynomial += term * power;
        power *= z;
      }
      k[q] *= polynomial;
    }
  }
  if (cut.variation.orthogonal) {
    const OrthogonalData& o = *cut.variation.orthogonal;
    const double a = o.rake_angle, i = std::atan(tan_i);
    const double phi = quantity(o.shear_angle, a, h);
    const double b = std::atan(std::tan(quantity(o.friction_angle, a, h)) * std::cos(i));
    const double side = std::tan(i) * std::sin(b);
    const double c0 = std::sqrt(std::pow(std::cos(phi + b - a), 2) + side * side);
    const double stress = quantity(o.shear_stress, a, h) / (std::sin(phi) * c0);
    k[0] *= stress * (std::cos(b - a) + std::tan(i) * side);
    k[1] *= stress * std::sin(b - a) / std::cos(i);
    k[2] *= stress * (std::cos(b - a) * std::tan(i) - side);
  }
  for (int q = 0; q < 3; ++q) {
    const double m = cut.variation.size_exponent[q];
    if (m != 0.0) k[q] *= std::pow(h / cut.variation.reference_chip_thickness, -m);
  }
  return k;
}

Chip chip(const Tool& tool, const Feed& feed, int flute, double tip_angle, double z) {
  const int count = tool.flutes();
  const double lambda = tool.lambda(z);
  const Place p = tool.place(z);
  const auto position = [&](int j) { return tool.position(j) - tool.tangent(j) * lambda; };
  const double phi = tip_angle - tool.tangent(flute) * lambda;
  const double advance = feed.per_tooth * (std::cos(feed.slope) * std::sin(phi) * p.sin_kappa -
                                           std::sin(feed.slope) * p.cos_kappa);
  Chip least{0.0, 0};
  for (int m = 1; m <= (tool.runs_out() ? count : 1); ++m) {
    const int other = (flute + m) % count;
    double angle = position(other) - position(flute);
    if (flute + m >= count) angle += kTurn;
    double h = (m == count ? count : count / kTurn * angle) * advance;
    if (tool.runs_out() && m < count) {
      h += p.sin_kappa *
           (runout_radius(tool, position(flute), z) - runout_radius(tool, position(other), z));
    }
    if (least.decided_by == 0 || h < least.thickness) least = {h, m};
  }
  return least;
}

bool always_has_chip(const Tool& tool, const Cut& cut) {
  if (tool.runs_out()) return false;
  for (const Stretch& s : tool.stretches()) {
    if (s.bottom >= cut.axial_depth) break;
    const double top = std::min(s.top, cut.axial_depth);
    for (const double z : {s.bottom + 1e-9 * (top - s.bottom), top - 1e-9 * (top - s.bottom)}) {
      if (cut.feed.slope * tool.place(z).cos_kappa > 1e-15) return false;
    }
  }
  return true;
}

}  // namespace millstudy::force::reference
