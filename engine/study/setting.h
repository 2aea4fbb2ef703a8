// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "path/curve.h"

namespace millstudy::study {

/// A curve as a study holds it.
struct StudyCurve {
  path::Curve curve;
  std::string canonical;  ///< every number of it, for the study hash
  bool planar = true;     ///< lies in a plane of constant z
};
using CurvePtr = std::shared_ptr<const StudyCurve>;

/// The checked value of one key, in the unit of the key.
using Setting = std::variant<double, bool, std::string, CurvePtr>;

}  // namespace millstudy::study
