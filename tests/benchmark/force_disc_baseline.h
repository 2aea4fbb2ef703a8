// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "force/coefficients.h"

/// The baseline of bench_force: what a careful program does with the paper's equal-height discs.
///
/// A flat cutter, forces x, y, z at every angle of a revolution as the sum over all discs of all
/// teeth, with the gate of the engagement and all six coefficients. No sine is computed: those of
/// the angles and of the discs behind flute 0 are prepared, and a disc's are their product (angle
/// addition). One `omp simd` loop runs over the discs of all teeth. A slot, so that the gate is
/// sin(phi) > 0: no angle has to be reduced, the cheapest gate there is.
namespace millstudy::baseline {

class DiscForce {
 public:
  /// @param discs  a tooth
  DiscForce(double diameter, int flutes, double helix_angle, double axial_depth, int discs,
            int angular_steps)
      : height_(axial_depth / discs) {
    for (int i = 0; i < angular_steps; ++i) {
      const double phi = 2.0 * core::kPi * i / angular_steps;
      sin_phi_.push_back(std::sin(phi));
      cos_phi_.push_back(std::cos(phi));
    }
    for (int i = 0; i < flutes * discs; ++i) {
      const double z = (i % discs + 0.5) * height_;
      const double behind =
          2.0 * std::tan(helix_angle) / diameter * z - 2.0 * core::kPi * (i / discs) / flutes;
      sin_behind_.push_back(std::sin(behind));
      cos_behind_.push_back(std::cos(behind));
    }
  }

  /// Forces of one revolution, each array of angular_steps values.
  void revolution(const force::Coefficients& k, double feed_per_tooth, double* x, double* y,
                  double* z) const {
    const force::Coefficients load{feed_per_tooth * k.Ktc,
                                   feed_per_tooth * k.Krc,
                                   feed_per_tooth * k.Kac,
                                   k.Kte,
                                   k.Kre,
                                   k.Kae};
    const int discs = static_cast<int>(sin_behind_.size());
    for (std::size_t i = 0; i < sin_phi_.size(); ++i) {
      const std::array<double, 3> sum =
          sum_discs(sin_behind_.data(), cos_behind_.data(), discs, sin_phi_[i], cos_phi_[i], load);
      x[i] = sum[0] * height_, y[i] = sum[1] * height_, z[i] = sum[2] * height_;
    }
  }

 private:
  /// Not inlined: inlined, the compiler keeps the sums in memory, which makes it slower.
  [[gnu::noinline]] static std::array<double, 3> sum_discs(const double* __restrict sin_behind,
                                                           const double* __restrict cos_behind,
                                                           int discs, double sin_phi,
                                                           double cos_phi,
                                                           force::Coefficients load) {
    // Five sums, so that no addition waits for the one before it.
    double xt = 0.0, xr = 0.0, yt = 0.0, yr = 0.0, z = 0.0;
#pragma omp simd reduction(+ : xt, xr, yt, yr, z)
    for (int d = 0; d < discs; ++d) {
      const double s = sin_phi * cos_behind[d] - cos_phi * sin_behind[d];
      const double c = cos_phi * cos_behind[d] + sin_phi * sin_behind[d];
      const double tangential = s > 0.0 ? load.Ktc * s + load.Kte : 0.0;
      const double radial = s > 0.0 ? load.Krc * s + load.Kre : 0.0;
      const double axial = s > 0.0 ? load.Kac * s + load.Kae : 0.0;
      xt -= tangential * c;
      xr -= radial * s;
      yt += tangential * s;
      yr -= radial * c;
      z -= axial;
    }
    return {xt + xr, yt + yr, z};
  }

  double height_;
  std::vector<double> sin_phi_, cos_phi_;        // shape (angular_steps)
  std::vector<double> sin_behind_, cos_behind_;  // shape (flutes, discs)
};

}  // namespace millstudy::baseline
