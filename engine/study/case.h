// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "cutter/cutter.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "path/interpolate.h"
#include "study/setting.h"

namespace millstudy::study {

enum class Milling { slot, up, down };

struct PathSection {
  CurvePtr curve;
  path::InterpolationSettings interpolation;  ///< its feed rate is that of the cut
};

struct CutSection {
  double axial_depth = 0.0;              ///< [mm]
  std::optional<Milling> milling;        ///< or entry and exit angle
  std::optional<double> radial_depth;    ///< [mm], up and down milling
  std::optional<double> entry_angle;     ///< [rad]
  std::optional<double> exit_angle;      ///< [rad]
  double spindle_speed = 0.0;            ///< [rev/s]
  std::optional<double> feed_rate;       ///< [mm/s]; this or the next
  std::optional<double> feed_per_tooth;  ///< [mm]
};

/// One point of a study in native units: what the keys set and the kinds compute from.
struct Case {
  PathSection path;
  cutter::Cutter cutter;
  force::Coefficients coefficients;
  CutSection cut;
  force::EdgeRule edge_rule;
  int angular_steps = 360;
};

/// Feed rate [mm/s], from feed per tooth where that is given.
double feed_rate(const Case& point);
/// Feed per tooth [mm], from feed rate where that is given.
double feed_per_tooth(const Case& point);
/// Entry, exit and depth. @throws core::CaseError if the depths do not fit the cutter, or exit is
/// not after entry.
force::Engagement engagement(const Case& point);
/// Peripheral cutting speed [mm/s].
double cutting_speed(const Case& point);
/// Radial depth over diameter, 1 in a slot.
double radial_immersion(const Case& point);
/// Discs evaluated for the samples of one revolution and tooth; 0 for the exact rule.
double disc_samples(const Case& point);
/// Above this many a revolution takes seconds a tooth: refused.
inline constexpr double kMostDiscSamples = 1e9;
inline constexpr const char* kTooManyDiscs =
    "numerics.discs x numerics.angular_steps must be <= 1e9 with rule discs";
/// @throws core::CaseError if feed per tooth exceeds the cutter's radius: no chip is like that, the
/// spindle speed or the feed rate is mistaken
void check_feed(const Case& point);
/// Volume removed per time [mm3/s]: feed rate times the cross-section of the engaged envelope.
double material_removal_rate(const Case& point);

}  // namespace millstudy::study
