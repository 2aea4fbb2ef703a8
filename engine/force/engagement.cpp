// SPDX-License-Identifier: MIT
#include "force/engagement.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "cutter/envelope.h"
#include "cutter/flutes.h"

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

void check(const Arc& arc) {
  const double entry_deg = core::deg_from_rad(arc.entry_angle);
  const double exit_deg = core::deg_from_rad(arc.exit_angle);
  // A few roundings beyond 180 deg are let pass: exit angles come from acos and from degrees.
  if (!(arc.entry_angle >= 0.0 && arc.entry_angle < arc.exit_angle &&
        arc.exit_angle <= core::kPi + 1e-12)) {
    throw core::InputError("entry_angle = " + std::to_string(entry_deg) + " deg and exit_angle = " +
                           std::to_string(exit_deg) + " deg must satisfy 0 <= entry < exit <= 180");
  }
}

void check(const cutter::Cutter& cutter, const Engagement& engagement) {
  check(engagement.arc());
  const double depth = engagement.axial_depth;
  if (!(depth > 0.0 && std::isfinite(depth))) {
    throw core::InputError("axial_depth = " + std::to_string(depth) + " mm must be > 0 and finite");
  }
  const cutter::Envelope envelope(cutter);
  if (!(depth <= envelope.length())) {
    throw core::InputError("axial_depth = " + std::to_string(depth) +
                           " mm must be at most the length of the cutter, " +
                           std::to_string(envelope.length()) + " mm");
  }
  if (!(depth <= largest_axial_depth(cutter))) {
    throw core::InputError("axial_depth = " + std::to_string(depth) +
                           " mm must not exceed 1000 turns of the helix");
  }
  const std::vector<cutter::Flute> flutes = cutter::flutes(cutter);
  const double lag = envelope.lag(depth);
  for (std::size_t j = 0; j < flutes.size(); ++j) {
    const std::size_t next = (j + 1) % flutes.size();
    const double pitch =
        flutes[next].position - flutes[j].position + (next <= j ? core::kTurn : 0.0);
    const double closing = (flutes[next].helix_tangent - flutes[j].helix_tangent) * lag;
    if (!(closing < pitch)) {
      throw core::InputError("flutes " + std::to_string(j + 1) + " and " +
                             std::to_string(next + 1) + " cross within the axial depth: check " +
                             "their helix angles and pitch");
    }
  }
}

double largest_axial_depth(const cutter::Cutter& cutter) {
  const cutter::Envelope envelope(cutter);
  // Not of cutter::flutes(): the lists may still be of the wrong length here.
  double steepest = cutter.helix_angles.empty() ? std::abs(std::tan(cutter.helix_angle)) : 0.0;
  for (const double helix : cutter.helix_angles) {
    steepest = std::max(steepest, std::abs(std::tan(helix)));
  }
  const double turns = kMostTurns * core::kTurn / steepest;
  return std::min(envelope.length(),
                  std::isfinite(turns) ? envelope.height_at_lag(turns) : envelope.length());
}

void check(const EdgeRule& edge_rule) {
  if (edge_rule.discs < 1 || edge_rule.discs > kMostDiscs) {
    throw core::InputError("discs = " + std::to_string(edge_rule.discs) +
                           " must be between 1 and " + std::to_string(kMostDiscs));
  }
}

}  // namespace millstudy::force
