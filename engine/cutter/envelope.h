// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "cutter/cutter.h"

namespace millstudy::cutter {

/// The cutting edge at one height above the tip.
struct EnvelopePoint {
  double radius;     ///< r, distance from the tool axis [mm]
  double kappa;      ///< axial immersion angle, normal against the tool axis [rad], 0 .. pi
  double lag_angle;  ///< psi, how far this point trails the tip [rad]; negative for left hand
};

/// A stretch of the envelope that is one line or one arc of its meridian.
///
/// Each is integrated in the variable p in which nothing is singular: p = kappa on an arc, p = z on
/// a line (C11).
struct Segment {
  double bottom;  ///< [mm] above the tip
  double top;     ///< [mm], > bottom; infinite on the last one of an end mill of any length
  bool is_arc;
  // A line.
  double foot_radius = 0.0;  ///< r at the bottom [mm]
  double slope = 0.0;        ///< dr/dz = cot(kappa)
  // An arc.
  double centre_radius = 0.0;  ///< [mm]
  double centre_height = 0.0;  ///< [mm]
  double corner_radius = 0.0;  ///< [mm]

  bool is_cylinder() const { return !is_arc && slope == 0.0; }
  double radius_at(double z) const;
  double kappa_at(double z) const;
};

/// Meridian and lag of an end mill, from its tip up: lines and arcs (C3), (C7), (C8).
class Envelope {
 public:
  /// Of a cutter whose numbers check() lets pass; throws core::InputError where tip, corner and
  /// taper do not join.
  explicit Envelope(const Cutter& cutter);

  /// In ascending order, without gaps; the first begins at 0.
  std::span<const Segment> segments() const { return segments_; }
  /// The segment at a height; at a boundary the upper one.
  const Segment& segment_at(double z) const;

  /// (C5), (C13): lag angle at a height over the tangent of the helix angle. Zero at the tip,
  /// ascending, exact to rounding.
  double lag(double z) const;
  /// Its slope over height [1/mm].
  double lag_slope(double z) const;
  /// The height of a lag: the inverse of lag().
  double height_at_lag(double lag) const;

  /// (C10): edge length per chip width at a point [1].
  ///
  /// @param helix_tangent  of the flute, of either sign
  /// @param radius, sin_kappa, lag_slope  of the point
  double edge_per_width(double helix_tangent, double radius, double sin_kappa,
                        double lag_slope) const;

  /// The height up to which the envelope goes [mm]; infinite for most.
  double length() const { return segments_.back().top; }

 private:
  std::vector<Segment> segments_;
  double diameter_;
  // Constant helix along a taper: from here on (C13) instead of (C5).
  double helix_from_;        // height [mm], infinite with constant lead
  double helix_radius_ = 1;  // radius there [mm]
  double helix_slope_ = 0;   // tan(tau), tau the taper
  double helix_sine_ = 0;    // its sine
  bool edge_is_chip_width_ = false;
};

/// The edge of flute 0 at a height.
///
/// @param z  height above the tip [mm], >= 0
/// @return exact to rounding, relative to each member, also next to the tip
EnvelopePoint envelope(const Cutter& cutter, double z);

/// (C12): integral of r from the tip to a height [mm2].
///
/// Times (cos entry_angle - cos exit_angle) it is the section swept by the cut, and that times the
/// feed rate the material removal rate. Error below 1e-15 R^2 (measured).
/// @param depth  height above the tip [mm], 0 .. length()
double section_area(const Envelope& envelope, double depth);

/// Largest sin(kappa) below a height [1]; the chip is thickest there.
/// @param depth  height above the tip [mm], >= 0
double largest_sin_kappa(const Envelope& envelope, double depth);

}  // namespace millstudy::cutter
