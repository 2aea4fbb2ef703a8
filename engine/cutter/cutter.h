// SPDX-License-Identifier: MIT
#pragma once

namespace millstudy::cutter {

/// Envelope of the cutting edges. Above the ball the tool is a cylinder.
///
/// What a shape changes is decided in envelope.cpp and in add_edge() of room force, by switches
/// without default: the compiler names the places that a new shape has to fill in.
enum class Shape { flat, ball };

/// An end mill whose flutes are equal and equally spaced.
struct Cutter {
  Shape shape = Shape::flat;
  double diameter = 12.0;    ///< D [mm], 1e-3 .. 1e4
  int flutes = 2;            ///< N, 1 .. 1000
  double helix_angle = 0.0;  ///< at the cylinder [rad], within +-80 deg; left hand is negative
};

/// Throws core::InputError for the first quantity out of the range stated above.
void check(const Cutter& cutter);

/// Half the diameter [mm].
inline double radius(const Cutter& cutter) {
  return 0.5 * cutter.diameter;
}

/// (C4): k_theta = 2 tan(helix) / D, the lag angle per height [rad/mm]; negative for left hand.
double lag_rate(const Cutter& cutter);

/// Angle between two flutes [rad].
double pitch_angle(const Cutter& cutter);

}  // namespace millstudy::cutter
