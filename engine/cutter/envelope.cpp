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
  const EnvelopePoint cylinder = {radius(cutter), 0.5 * core::kPi, lag_angle};
  if (z >= curved_height(cutter)) return cylinder;
  switch (cutter.shape) {
    case Shape::flat:
      return cylinder;
    case Shape::ball:
      return {std::sqrt(z * (cutter.diameter - z)), ball_kappa(cutter, z), lag_angle};
  }
  __builtin_unreachable();
}

double curved_height(const Cutter& cutter) {
  switch (cutter.shape) {
    case Shape::flat:
      return 0.0;
    case Shape::ball:
      return radius(cutter);
  }
  __builtin_unreachable();
}

double edge_length_rate(const Cutter& cutter) {
  switch (cutter.shape) {
    case Shape::flat:
      return 1.0;
    case Shape::ball:
      return 1.0 / std::cos(cutter.helix_angle);
  }
  __builtin_unreachable();
}

double curved_edge_per_width(const Cutter& cutter, double sin_kappa) {
  switch (cutter.shape) {
    case Shape::flat:
      return 1.0;  // it has no curved part
    case Shape::ball:
      return ball_edge_per_width(std::tan(cutter.helix_angle), sin_kappa);
  }
  __builtin_unreachable();
}

namespace {

/// x - sin(x), also where they are nearly equal: its Taylor series below 1, to rounding.
double less_its_sine(double x) {
  if (x > 1.0) return x - std::sin(x);
  double sum = 1.0;
  for (int n = 18; n >= 4; n -= 2) sum = 1.0 - x * x / (n * (n + 1)) * sum;
  return x * x * x / 6.0 * sum;
}

}  // namespace

double section_area(const Cutter& cutter, double depth) {
  const double r = radius(cutter);
  switch (cutter.shape) {
    case Shape::flat:
      return r * depth;
    case Shape::ball: {
      const double curved = std::min(depth, r);
      const double kappa = ball_kappa(cutter, curved);
      return r * (depth - curved) + 0.25 * r * r * less_its_sine(2.0 * kappa);
    }
  }
  __builtin_unreachable();
}

double largest_sin_kappa(const Cutter& cutter, double depth) {
  return depth >= curved_height(cutter) ? 1.0 : envelope(cutter, depth).radius / radius(cutter);
}

}  // namespace millstudy::cutter
