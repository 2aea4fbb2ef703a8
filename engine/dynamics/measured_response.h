// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace millstudy::dynamics {

/// A frequency response as measured: displacement of the tool over force along one axis.
struct MeasuredResponse {
  std::vector<double> omega;                     ///< [rad/s], ascending, >= 0
  std::vector<std::complex<double>> compliance;  ///< [mm/N], of the same length

  /// Linear between the measured frequencies; below them as at the first, above them falling with
  /// the square of frequency, as a mass does.
  std::complex<double> at(double frequency) const;
};

/// Of the tool along x and y; null where nothing was measured.
struct MeasuredAxes {
  std::shared_ptr<const MeasuredResponse> x;
  std::shared_ptr<const MeasuredResponse> y;
};

struct ResponseFault {
  std::size_t at;  ///< which of the frequencies
  std::string text;
};

/// What is wrong: lengths that differ, fewer than three frequencies, ones that do not ascend, a gap
/// more than ten times as wide as those beside it, numbers that are not finite, and amplitudes and
/// phases that no displacement over a force at the same place has. The first twenty.
std::vector<ResponseFault> faults(const MeasuredResponse& measured);

/// Throws core::InputError with the first fault.
void check(const MeasuredResponse& measured);

}  // namespace millstudy::dynamics
