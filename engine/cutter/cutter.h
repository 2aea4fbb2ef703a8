// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

namespace millstudy::cutter {

/// Envelope of the cutting edges. All are cases of the general end mill; what each fixes is in
/// apt_of() in envelope.cpp, and nowhere else.
enum class Shape { flat, ball, bull_nose, taper, general, profile };

/// How the edge winds along a taper; elsewhere the lead is constant.
enum class Lead { constant_lead, constant_helix };

/// What edge-force coefficients are per unit of; see (C10).
enum class EdgeMeasure {
  automatic,    ///< chip width on an all-cylindrical envelope, edge length on every other
  chip_width,   ///< db
  edge_length,  ///< dS
};

/// A point of a profile: height above the tip and distance from the axis [mm].
struct ProfilePoint {
  double z;
  double r;
};
using Profile = std::vector<ProfilePoint>;

/// Where the cutter's axis is, seen from the spindle's axis. Angles are positions on the cutter,
/// from the tip of flute 0 towards flute 1.
struct Runout {
  double offset = 0.0;      ///< distance of the axes at the tip [mm]
  double angle = 0.0;       ///< where the offset points [rad]
  double tilt = 0.0;        ///< angle between the axes [rad]
  double tilt_angle = 0.0;  ///< where the cutter's axis leans to, going up from the tip [rad]
};

/// An end mill.
struct Cutter {
  Shape shape = Shape::flat;
  double diameter =
      12.0;        ///< D [mm], 1e-3 .. 1e4; of taper and general where the taper meets z = 0
  int flutes = 2;  ///< N, 1 .. 1000
  double helix_angle = 0.0;  ///< at the diameter [rad], within +-80 deg; left hand is negative

  double corner_radius = 0.0;  ///< R_c [mm], of bull_nose, taper, general
  double taper_angle =
      0.0;                 ///< beta against the axis [rad], -45 .. 80 deg; of ball, taper, general
  double tip_angle = 0.0;  ///< alpha of the tip cone against the plane [rad], 0 .. 80 deg; general
  std::optional<double> corner_centre_radius;  ///< R_r [mm], of general; else the corner is tangent
  std::optional<double> corner_centre_height;  ///< R_z [mm], likewise; both or none
  std::optional<double> flute_length;          ///< h [mm]: no cut is deeper
  Lead lead = Lead::constant_lead;
  EdgeMeasure edge_measure = EdgeMeasure::automatic;
  std::shared_ptr<const Profile> profile = nullptr;  ///< of profile: heights ascending from 0

  std::vector<double> pitch_angles =
      {};  ///< [j] from flute j to j + 1 [rad], sum 2 pi; empty: equal
  std::vector<double> helix_angles = {};  ///< of each flute [rad]; empty: helix_angle for all
  Runout runout = {};
};

/// Throws core::InputError with every quantity that is out of the range stated above, and for a
/// combination that is no end mill.
void check(const Cutter& cutter);

/// Half the diameter [mm].
inline double radius(const Cutter& cutter) {
  return 0.5 * cutter.diameter;
}

/// (C4): k_theta = 2 tan(helix) / D, the lag angle per height [rad/mm]; negative for left hand. Of
/// the helix angle that flutes have in common.
double lag_rate(const Cutter& cutter);

/// Angle between two equally spaced flutes [rad].
double pitch_angle(const Cutter& cutter);

}  // namespace millstudy::cutter
