// SPDX-License-Identifier: MIT
#include "cutter/cutter.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/units.h"
#include "cutter/envelope.h"

namespace millstudy::cutter {
namespace {

constexpr double kSmallestDiameter = 1e-3;
constexpr double kLargestDiameter = 1e4;
constexpr int kMostFlutes = 1000;
constexpr double kSteepestHelix_deg = 80.0;
constexpr double kLargestTilt_deg = 10.0;

/// Collects what is out of range, so that all of it is told at once.
class Checker {
 public:
  /// Written so that NaN fails.
  void between(const char* name, double value, double low, double high, const char* unit) {
    constexpr double kRounding = 1e-9;
    if (value >= low - kRounding * std::abs(low) && value <= high + kRounding * std::abs(high))
      return;
    holds(false, std::string(name) + " = " + std::to_string(value) + unit + " must be between " +
                     std::to_string(low) + " and " + std::to_string(high) + unit);
  }
  void angle(const char* name, double value, double low_deg, double high_deg) {
    between(name, core::deg_from_rad(value), low_deg, high_deg, " deg");
  }
  void holds(bool fine, std::string text) {
    if (!fine) faults_.push_back({{}, std::move(text)});
  }
  void finish() const {
    if (!faults_.empty()) throw core::InputError(faults_);
  }

 private:
  std::vector<core::Fault> faults_;
};

void check_flutes(const Cutter& cutter, Checker& checker) {
  const auto count = static_cast<std::size_t>(cutter.flutes);
  for (const double helix : cutter.helix_angles) {
    checker.angle("helix_angles", helix, -kSteepestHelix_deg, kSteepestHelix_deg);
  }
  checker.holds(cutter.helix_angles.empty() || cutter.helix_angles.size() == count,
                "helix_angles must have one angle for each flute");
  checker.holds(cutter.pitch_angles.empty() || cutter.pitch_angles.size() == count,
                "pitch_angles must have one angle for each flute");
  const double sum = std::accumulate(cutter.pitch_angles.begin(), cutter.pitch_angles.end(), 0.0);
  checker.holds(cutter.pitch_angles.empty() || std::abs(sum - core::kTurn) < 1e-9,
                "pitch_angles must sum to 360 deg, not " + std::to_string(core::deg_from_rad(sum)));
  checker.holds(std::all_of(cutter.pitch_angles.begin(), cutter.pitch_angles.end(),
                            [](double pitch) { return pitch > 0.0; }),
                "pitch_angles must be > 0");
  checker.holds(std::all_of(cutter.helix_angles.begin(), cutter.helix_angles.end(),
                            [&](double helix) {
                              return (helix < 0.0) == (cutter.helix_angles.front() < 0.0);
                            }),
                "helix_angles must be all right-hand (or zero) or all left-hand");
}

void check_profile(const Cutter& cutter, Checker& checker) {
  const Profile* profile = cutter.profile.get();
  checker.holds(profile && profile->size() >= 2, "a profile must have at least two points");
  if (!profile || profile->empty()) return;
  checker.holds(profile->front().z == 0.0, "the heights of a profile must begin with 0");
  checker.holds(std::any_of(profile->begin(), profile->end(),
                            [](const ProfilePoint& point) { return point.r > 0.0; }),
                "a profile must have a radius above 0 mm");
  for (std::size_t i = 0; i < profile->size(); ++i) {
    const auto [z, r] = (*profile)[i];
    if (!(r >= 0.0 && r <= kLargestDiameter && z <= kLargestDiameter)) {
      return checker.holds(false, "the points of a profile must be within 0 and 10000 mm");
    }
    constexpr double kLeastStep = 1e-9;  // [mm]: slopes stay numbers
    if (i > 0 && !(z >= (*profile)[i - 1].z + kLeastStep)) {
      return checker.holds(false, "the heights of a profile must ascend, by 1e-9 mm at least");
    }
  }
}

}  // namespace

void check(const Cutter& cutter) {
  Checker checker;
  checker.between("diameter", cutter.diameter, kSmallestDiameter, kLargestDiameter, " mm");
  checker.holds(cutter.flutes >= 1 && cutter.flutes <= kMostFlutes,
                "flutes = " + std::to_string(cutter.flutes) + " must be between 1 and " +
                    std::to_string(kMostFlutes));
  checker.angle("helix_angle", cutter.helix_angle, -kSteepestHelix_deg, kSteepestHelix_deg);
  checker.angle("taper_angle", cutter.taper_angle, -45.0, 80.0);
  checker.angle("tip_angle", cutter.tip_angle, 0.0, 80.0);
  checker.holds(cutter.corner_radius >= 0.0 && cutter.corner_radius <= kLargestDiameter,
                "corner_radius must be between 0 and 10000 mm");
  checker.holds(cutter.shape != Shape::bull_nose || cutter.corner_radius <= 0.5 * cutter.diameter,
                "corner_radius must be at most half the diameter");
  checker.holds(cutter.corner_centre_radius.has_value() == cutter.corner_centre_height.has_value(),
                "corner_centre_radius and corner_centre_height must be given together");
  checker.holds(!cutter.flute_length || *cutter.flute_length > 0.0, "flute_length must be > 0");
  checker.between("runout.offset", cutter.runout.offset, 0.0, 0.5 * cutter.diameter, " mm");
  checker.angle("runout.tilt", cutter.runout.tilt, 0.0, kLargestTilt_deg);
  checker.holds(std::isfinite(cutter.runout.angle) && std::isfinite(cutter.runout.tilt_angle),
                "the angles of runout must be finite");
  check_flutes(cutter, checker);
  if (cutter.shape == Shape::profile) check_profile(cutter, checker);
  checker.finish();
  Envelope{cutter};
}

double lag_rate(const Cutter& cutter) {
  return 2.0 * std::tan(cutter.helix_angle) / cutter.diameter;
}

double pitch_angle(const Cutter& cutter) {
  return core::kTurn / cutter.flutes;
}

}  // namespace millstudy::cutter
