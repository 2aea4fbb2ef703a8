// SPDX-License-Identifier: MIT
#include "cutter/envelope.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace millstudy::cutter {
namespace {

/// (C8) through the half angle: kappa = 2 asin sqrt(z/D) keeps its digits at both ends, which
/// asin(2 r/D) does not where r reaches R.
double ball_kappa(const Cutter& cutter, double z) {
  const double part = std::clamp(z / cutter.diameter, 0.0, 0.5);
  return 2.0 * std::asin(std::sqrt(part));
}

}  // namespace

EnvelopePoint envelope(const Cutter& cutter, double z) {
  const double lag_angle = lag_rate(cutter) * z;
  if (z >= curved_height(cutter)) return {radius(cutter), 0.5 * core::kPi, lag_angle};
  return {std::sqrt(z * (cutter.diameter - z)), ball_kappa(cutter, z), lag_angle};
}

double curved_height(const Cutter& cutter) {
  return cutter.shape == Shape::ball ? radius(cutter) : 0.0;
}

double edge_length_rate(const Cutter& cutter) {
  return cutter.shape == Shape::flat ? 1.0 : 1.0 / std::cos(cutter.helix_angle);
}

double section_area(const Cutter& cutter, double depth) {
  const double r = radius(cutter);
  const double curved = std::min(depth, curved_height(cutter));
  const double kappa = curved > 0.0 ? ball_kappa(cutter, curved) : 0.0;
  return r * (depth - curved) + 0.5 * r * r * (kappa - 0.5 * std::sin(2.0 * kappa));
}

double largest_sin_kappa(const Cutter& cutter, double depth) {
  return depth >= curved_height(cutter) ? 1.0 : envelope(cutter, depth).radius / radius(cutter);
}

}  // namespace millstudy::cutter
