// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace millstudy::identify {

/// Names of the axes of a trace, in their order.
inline constexpr std::array<std::string_view, 3> kAxisNames = {"x", "y", "z"};

/// Forces on the tool in the model's axes over one time window, evenly sampled: what a fit is made
/// to. Sample i was taken at start + i / sampling_rate.
struct Trace {
  std::string source;                        ///< the file it was read from, for messages
  double sampling_rate = 0.0;                ///< [1/s], > 0
  double start = 0.0;                        ///< of the first sample, on the clock of the file [s]
  std::array<std::vector<double>, 3> force;  ///< x, y, z [N]; equal lengths, or empty: not measured

  /// Samples per axis.
  std::size_t size() const;
  bool has_axis(int axis) const { return !force[axis].empty(); }
};

/// Throws core::InputError for a sampling rate that is not > 0, axes of unequal length, none at all
/// and numbers that are not finite.
void check(const Trace& trace);

}  // namespace millstudy::identify
