// SPDX-License-Identifier: MIT
#include "force/engagement.h"

#include <cmath>
#include <string>

#include "core/error.h"

namespace millstudy::force {
namespace {

constexpr int kMostDiscs = 1'000'000;
constexpr double kMostTurns = 1000.0;

/// Angle from the edge of the cut to the feed direction's normal, acos(1 - ae/R).
double immersed_angle(double radius, double radial_depth) {
  if (!(radius > 0.0)) {
    throw core::InputError("radius = " + std::to_string(radius) + " mm must be > 0");
  }
  if (!(radial_depth > 0.0 && radial_depth <= 2.0 * radius)) {
    throw core::InputError("radial_depth = " + std::to_string(radial_depth) +
                           " mm must be > 0 and <= the diameter, " + std::to_string(2.0 * radius) +
                           " mm");
  }
  // 2 asin sqrt(ae/D) is acos(1 - ae/R) without the loss of digits at small radial depth.
  return 2.0 * std::asin(std::sqrt(0.5 * radial_depth / radius));
}

}  // namespace

Engagement slot(double axial_depth) {
  return {0.0, core::kPi, axial_depth};
}

Engagement up_milling(double radius, double radial_depth, double axial_depth) {
  return {0.0, immersed_angle(radius, radial_depth), axial_depth};
}

Engagement down_milling(double radius, double radial_depth, double axial_depth) {
  return {core::kPi - immersed_angle(radius, radial_depth), core::kPi, axial_depth};
}

void check(const cutter::Cutter& cutter, const Engagement& engagement) {
  const double entry_deg = core::deg_from_rad(engagement.entry_angle);
  const double exit_deg = core::deg_from_rad(engagement.exit_angle);
  // A few roundings beyond 180 deg are let pass: exit angles come from acos and from degrees.
  if (!(engagement.entry_angle >= 0.0 && engagement.entry_angle < engagement.exit_angle &&
        engagement.exit_angle <= core::kPi + 1e-12)) {
    throw core::InputError("entry_angle = " + std::to_string(entry_deg) + " deg and exit_angle = " +
                           std::to_string(exit_deg) + " deg must satisfy 0 <= entry < exit <= 180");
  }
  if (!(engagement.axial_depth > 0.0 && std::isfinite(engagement.axial_depth))) {
    throw core::InputError("axial_depth = " + std::to_string(engagement.axial_depth) +
                           " mm must be > 0 and finite");
  }
  if (!(engagement.axial_depth <= largest_axial_depth(cutter))) {
    throw core::InputError("axial_depth = " + std::to_string(engagement.axial_depth) +
                           " mm must not exceed 1000 turns of the helix");
  }
}

double largest_axial_depth(const cutter::Cutter& cutter) {
  return kMostTurns * 2.0 * core::kPi / std::abs(cutter::lag_rate(cutter));
}

void check(const EdgeRule& edge_rule) {
  if (edge_rule.discs < 1 || edge_rule.discs > kMostDiscs) {
    throw core::InputError("discs = " + std::to_string(edge_rule.discs) +
                           " must be between 1 and " + std::to_string(kMostDiscs));
  }
}

}  // namespace millstudy::force
