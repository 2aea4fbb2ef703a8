// SPDX-License-Identifier: MIT
#pragma once

#include "dynamics/mode.h"

namespace millstudy::dynamics {

/// One mode of a dynamometer along one axis, and its share in the signal; see (D40).
struct DynamometerMode {
  Mode mode;
  double gain = 0.0;  ///< [1]
};

}  // namespace millstudy::dynamics
