// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cutter/cutter.h"

namespace millstudy::cutter {

/// One cutting edge.
struct Flute {
  double position = 0.0;       ///< of its tip, ahead of that of flute 0 [rad]
  double helix_tangent = 0.0;  ///< tan of its helix angle; negative for left hand
};

/// The flutes in order of position; shape (N). Flute j follows flute j + 1. Of a cutter that
/// check() lets pass.
std::vector<Flute> flutes(const Cutter& cutter);

/// True if all flutes have one helix angle and one pitch, as far as doubles tell.
bool has_equal_flutes(const Cutter& cutter);

/// True if the helix angle differs from flute to flute: pitch then varies with height.
bool has_variable_helix(const Cutter& cutter);

/// True if the axes of cutter and spindle differ.
bool has_runout(const Cutter& cutter);

/// (C14): how far the edge of a flute stands out from the envelope, seen from the spindle axis, to
/// first order in offset over radius [mm].
///
/// @param position  angular position of the edge point on the cutter, that of its flute less its
///                  lag [rad]
/// @param z         height above the tip [mm]
double runout_at(const Runout& runout, double position, double z);

}  // namespace millstudy::cutter
