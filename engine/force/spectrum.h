// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "force/sampler.h"
#include "force/slice.h"
#include "force/unit_circle.h"

namespace millstudy::force {

/// Amplitudes of a force history at multiples of the tooth-passing frequency.
///
/// (F27): a_k = 2/n |sum F_s exp(-2 pi i k N s / S)|, once where k N = S / 2. Over whole
/// revolutions it is the Fourier series of the sampled force, exact to rounding; over a path, whose
/// feed turns, the mean over the path. Pieces come in any sizes, in order.
class Spectrum {
 public:
  /// @param harmonics      K, > 0; the highest, K flutes, at most half the angular steps
  /// @param angular_steps  S, samples a revolution
  /// Throws core::InputError for more harmonics than the samples resolve.
  Spectrum(int harmonics, int flutes, int angular_steps);

  /// The most harmonics that samples resolve.
  static int most_harmonics(int flutes, int angular_steps) { return angular_steps / (2 * flutes); }

  /// Takes in samples first .. first + count - 1.
  void add(const ForceSamples& samples, std::int64_t first, std::int64_t count);

  /// Amplitudes of rows x, y, z [N], torque [N mm]; shape (4, harmonics).
  std::array<std::vector<double>, kRows> amplitudes() const;

 private:
  int harmonics_;
  int flutes_;
  int steps_;
  std::int64_t count_ = 0;
  std::shared_ptr<const UnitCircle> circle_;
  std::array<std::vector<double>, kRows> real_;
  std::array<std::vector<double>, kRows> imaginary_;
};

}  // namespace millstudy::force
