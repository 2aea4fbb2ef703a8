// SPDX-License-Identifier: MIT
#include "force/spectrum.h"

#include <cmath>
#include <string>

#include "core/error.h"

namespace millstudy::force {

Spectrum::Spectrum(int harmonics, int flutes, int angular_steps)
    : harmonics_(harmonics), flutes_(flutes), steps_(angular_steps) {
  if (harmonics < 1 || harmonics > most_harmonics(flutes, angular_steps)) {
    throw core::InputError("harmonics = " + std::to_string(harmonics) +
                           " must be >= 1 and, times the flutes, at most half the angular steps");
  }
  circle_ = UnitCircle::of(steps_, steps_);
  for (int row = 0; row < kRows; ++row) {
    real_[row].assign(harmonics, 0.0);
    imaginary_[row].assign(harmonics, 0.0);
  }
}

void Spectrum::add(const ForceSamples& samples, std::int64_t first, std::int64_t count) {
  const std::array<const double*, kRows> rows = {samples.x.data(), samples.y.data(),
                                                 samples.z.data(), samples.torque.data()};
  const double* cosine = circle_->cosine.data();
  const double* sine = circle_->sine.data();
  for (int k = 0; k < harmonics_; ++k) {
    const std::int64_t stride = static_cast<std::int64_t>(k + 1) * flutes_ % steps_;
    std::int64_t at = (first % steps_ + steps_) % steps_ * stride % steps_;
    std::array<double, kRows> real{}, imaginary{};
    for (std::int64_t i = 0; i < count; ++i) {
      for (int row = 0; row < kRows; ++row) {
        real[row] += rows[row][i] * cosine[at];
        imaginary[row] += rows[row][i] * sine[at];
      }
      at += stride;
      if (at >= steps_) at -= steps_;
    }
    for (int row = 0; row < kRows; ++row) {
      real_[row][k] += real[row];
      imaginary_[row][k] += imaginary[row];
    }
  }
  count_ += count;
}

std::array<std::vector<double>, kRows> Spectrum::amplitudes() const {
  std::array<std::vector<double>, kRows> all;
  for (int row = 0; row < kRows; ++row) {
    for (int k = 0; k < harmonics_; ++k) {
      const bool highest = 2 * (k + 1) * flutes_ == steps_;
      const double scale = (highest ? 1.0 : 2.0) / static_cast<double>(count_);
      all[row].push_back(scale * std::hypot(real_[row][k], imaginary_[row][k]));
    }
  }
  return all;
}

}  // namespace millstudy::force
