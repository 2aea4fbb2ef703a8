// SPDX-License-Identifier: MIT
#include "cutter/cutter.h"

#include <cmath>
#include <string>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::cutter {
namespace {

constexpr double kSmallestDiameter = 1e-3;
constexpr double kLargestDiameter = 1e4;
constexpr int kMostFlutes = 1000;
constexpr double kSteepestHelix_deg = 80.0;

}  // namespace

void check(const Cutter& cutter) {
  // Written so that NaN fails.
  if (!(cutter.diameter >= kSmallestDiameter && cutter.diameter <= kLargestDiameter)) {
    throw core::InputError("diameter = " + std::to_string(cutter.diameter) +
                           " mm must be between 0.001 and 10000 mm");
  }
  if (cutter.flutes < 1 || cutter.flutes > kMostFlutes) {
    throw core::InputError("flutes = " + std::to_string(cutter.flutes) + " must be between 1 and " +
                           std::to_string(kMostFlutes));
  }
  const double helix_deg = core::deg_from_rad(cutter.helix_angle);
  if (!(std::abs(helix_deg) <= kSteepestHelix_deg + 1e-9)) {
    throw core::InputError("helix_angle = " + std::to_string(helix_deg) +
                           " deg must be between -80 and 80 deg");
  }
}

double lag_rate(const Cutter& cutter) {
  return 2.0 * std::tan(cutter.helix_angle) / cutter.diameter;
}

double pitch_angle(const Cutter& cutter) {
  return 2.0 * core::kPi / cutter.flutes;
}

}  // namespace millstudy::cutter
