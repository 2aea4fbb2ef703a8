// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "cutter/cutter.h"
#include "identify/mode_fit.h"
#include "path/curve.h"

namespace millstudy::study {

/// A curve as a study holds it.
struct StudyCurve {
  path::Curve curve;
  std::string canonical;  ///< every number of it, for the study hash
  double steepest = 0.0;  ///< largest slope up or down, of points all along it [rad]
};
using CurvePtr = std::shared_ptr<const StudyCurve>;

using ProfilePtr = std::shared_ptr<const cutter::Profile>;

/// A frequency response as a study holds it.
struct StudyResponse {
  std::shared_ptr<const dynamics::MeasuredResponse> measured;
  identify::ModeFit fit;  ///< for methods that need modes
  std::string canonical;  ///< every number of it, for the study hash
};
using ResponsePtr = std::shared_ptr<const StudyResponse>;

/// The checked value of one key, in the unit of the key; monostate where a point does not give it.
using Setting = std::variant<std::monostate, double, bool, std::string, std::vector<double>,
                             CurvePtr, ProfilePtr, ResponsePtr>;

}  // namespace millstudy::study
