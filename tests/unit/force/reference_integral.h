// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cutter/cutter.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "force/variation.h"

/// The force of an end mill once more, by other means: of the engine only the input structs are in
/// use here. Adaptive Gauss-Kronrod quadrature in height, from the definitions of DESIGN.md 2 and 3
/// and (F22), split where the law has a corner; corners are found by dense scan and bisection.
namespace millstudy::force::reference {

/// x, y, z [N], torque [N mm], moments about x and y through the tip [N mm].
using Load = std::array<double, 6>;

/// A line or a circular arc of the meridian, between two heights [mm].
struct Stretch {
  double bottom, top;
  bool arc;
  double r, slope;  // of a line: radius at its bottom, dr/dz
  double centre_r, centre_z, arc_radius;
};

/// The edge of a cutter at a height.
struct Place {
  double r, sin_kappa, cos_kappa;
};

class Tool {
 public:
  explicit Tool(const cutter::Cutter& cutter);

  Place place(double z) const;
  double lambda(double z) const;        ///< lag over the tangent of the helix [rad]
  double lambda_slope(double z) const;  ///< [rad/mm]
  double length() const { return stretches_.back().top; }
  const std::vector<Stretch>& stretches() const { return stretches_; }
  int flutes() const { return static_cast<int>(position_.size()); }
  double position(int flute) const { return position_[flute]; }
  double tangent(int flute) const { return tangent_[flute]; }
  const cutter::Runout& runout() const { return runout_; }
  bool runs_out() const { return runout_.offset != 0.0 || runout_.tilt != 0.0; }
  bool per_width() const { return per_width_; }

 private:
  std::vector<Stretch> stretches_;
  std::vector<double> position_, tangent_;
  cutter::Runout runout_;
  double diameter_;
  double taper_from_, taper_radius_, taper_angle_;  // of a constant helix
  bool per_width_;
};

/// Everything that decides a force.
struct Cut {
  cutter::Cutter cutter;
  double axial_depth;
  std::vector<Arc> arcs;  ///< one or two
  Coefficients coefficients;
  Feed feed;  ///< its direction does not count
  Variation variation;
};

/// Chip of flute j at a height, before it is kept from being negative [mm], and the flute that
/// decides it.
struct Chip {
  double thickness;
  int decided_by;
};
Chip chip(const Tool& tool, const Feed& feed, int flute, double tip_angle, double z);

/// Ktc Krc Kac [N/mm2], Kte Kre Kae [N/mm] at a height under a chip.
///
/// @param tan_i  of the local helix angle, without its sign
std::array<double, 6> coefficients_at(const Cut& cut, double z, double h, double tan_i);

/// Force of one flute in feed axes.
///
/// @param tip_angle  immersion angle of its edge at z = 0 [rad]
/// @param tolerance  of each smooth stretch [N]; torque and moments: times radius plus depth
Load flute_load(const Tool& tool, const Cut& cut, int flute, double tip_angle, double tolerance);

/// Of all flutes, flute 0 standing at phi.
Load load(const Tool& tool, const Cut& cut, double phi, double tolerance);

/// True if no edge point in cut can be without chip, so that the force is linear in its loads.
bool always_has_chip(const Tool& tool, const Cut& cut);

}  // namespace millstudy::force::reference
