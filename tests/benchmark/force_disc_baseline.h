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
/// the angles and of the discs' lags are prepared, and a disc's are their product (angle
/// addition). The loop over discs is `omp simd`. A slot, so that the gate is sin(phi) > 0: no
/// angle has to be reduced, the cheapest gate there is.
namespace millstudy::baseline {

class DiscForce {
 public:
  DiscForce(double diameter, int flutes, double helix_angle, double axial_depth, int discs,
            int angular_steps)
      : flutes_(flutes), steps_(angular_steps), height_(axial_depth / discs) {
    for (int i = 0; i < angular_steps * flutes; ++i) {
      const double phi =
          2.0 * core::kPi * (i / flutes) / angular_steps + 2.0 * core::kPi * (i % flutes) / flutes;
      sin_phi_.push_back(std::sin(phi));
      cos_phi_.push_back(std::cos(phi));
    }
    for (int i = 0; i < discs; ++i) {
      const double lag = 2.0 * std::tan(helix_angle) / diameter * (i + 0.5) * height_;
      sin_lag_.push_back(std::sin(lag));
      cos_lag_.push_back(std::cos(lag));
    }
  }

  /// Forces of one revolution, each array of angular_steps values.
  void revolution(const force::Coefficients& k, double feed_per_tooth, double* x, double* y,
                  double* z) const {
    for (int i = 0; i < steps_; ++i) {
      double sum_x = 0.0, sum_y = 0.0, sum_z = 0.0;
      for (int j = 0; j < flutes_; ++j) {
        const auto [fx, fy, fz] =
            tooth(k, feed_per_tooth, sin_phi_[i * flutes_ + j], cos_phi_[i * flutes_ + j]);
        sum_x += fx, sum_y += fy, sum_z += fz;
      }
      x[i] = sum_x * height_, y[i] = sum_y * height_, z[i] = sum_z * height_;
    }
  }

 private:
  std::array<double, 3> tooth(const force::Coefficients& k, double feed_per_tooth, double sin_phi,
                              double cos_phi) const {
    const force::Coefficients load{feed_per_tooth * k.Ktc,
                                   feed_per_tooth * k.Krc,
                                   feed_per_tooth * k.Kac,
                                   k.Kte,
                                   k.Kre,
                                   k.Kae};
    return sum_discs(sin_lag_.data(), cos_lag_.data(), static_cast<int>(sin_lag_.size()), sin_phi,
                     cos_phi, load);
  }

  /// Not inlined: inlined, the compiler keeps the sums in memory, and the loop is 1.5 times slower.
  [[gnu::noinline]] static std::array<double, 3> sum_discs(const double* __restrict sin_lag,
                                                           const double* __restrict cos_lag,
                                                           int discs, double sin_phi,
                                                           double cos_phi,
                                                           force::Coefficients load) {
    // Five sums, so that no addition waits for the one before it.
    double xt = 0.0, xr = 0.0, yt = 0.0, yr = 0.0, z = 0.0;
#pragma omp simd reduction(+ : xt, xr, yt, yr, z)
    for (int d = 0; d < discs; ++d) {
      const double s = sin_phi * cos_lag[d] - cos_phi * sin_lag[d];
      const double c = cos_phi * cos_lag[d] + sin_phi * sin_lag[d];
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

  int flutes_;
  int steps_;
  double height_;
  std::vector<double> sin_phi_, cos_phi_;  // shape (steps, flutes)
  std::vector<double> sin_lag_, cos_lag_;  // shape (discs)
};

}  // namespace millstudy::baseline
