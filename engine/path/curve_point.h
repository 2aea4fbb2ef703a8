// SPDX-License-Identifier: MIT
#pragma once

#include "path/vec3.h"

namespace millstudy::path {

/// Position and derivatives with respect to the parameter u.
struct CurvePoint {
  Vec3 position;  ///< R [mm]
  Vec3 first;     ///< R' [mm]
  Vec3 second;    ///< R'' [mm]
};

}  // namespace millstudy::path
