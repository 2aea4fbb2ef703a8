// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "core/error.h"

namespace millstudy::identify {

/// Where one axis of the model comes from; no channel: that axis was not measured.
struct AxisSource {
  std::string channel;
  double sign = 1.0;  ///< +1 or -1
};

/// The channels that are the forces on the tool along x, y and z of the model, with their signs.
///
/// A dynamometer under the workpiece measures the reaction, so the map of one that is aligned with
/// the model is x = "-Fx", y = "-Fy", z = "-Fz".
struct AxisMap {
  std::array<AxisSource, 3> axes;  ///< x, y, z

  bool has_axis(int axis) const { return !axes[axis].channel.empty(); }
  /// "x = -Fy, y = -Fx, z = Fz"
  std::string to_string() const;
};

/// Reads "-Fy", "+Fy" or "Fy" for each axis; an empty text is an axis that was not measured.
///
/// @throws core::InputError naming every axis whose channel has no name or is that of another axis,
///         or when there is no axis at all
AxisMap parse_axis_map(const std::array<std::string, 3>& texts, const core::Place& place = {});

}  // namespace millstudy::identify
