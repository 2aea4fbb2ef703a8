// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "force/coefficients.h"
#include "force/edge.h"

/// The baseline of bench_shapes: equal-height discs of any envelope, as carefully as those of the
/// flat cutter in force_disc_baseline.h.
///
/// A slot, forces x, y, z of all teeth, all six coefficients. Prepared: the sines of the spindle
/// angles and of the discs behind flute 0, whose sum no sine has to be computed for, and of every
/// disc sin(kappa), cos(kappa) and its length of edge. The chip of a disc is f sin(phi) dz on every
/// envelope (F1). One `omp simd` loop runs over the discs of all teeth; it goes through all angles
/// with one block of discs before it takes the next, so that the discs stay in the cache.
namespace millstudy::baseline {

class GeneralDiscForce {
 public:
  /// @param edges  of equal flutes of one helix angle
  /// @param discs  a tooth
  GeneralDiscForce(const force::CuttingEdges& edges, int discs, int angular_steps)
      : height_(edges.axial_depth() / discs) {
    for (int i = 0; i < angular_steps; ++i) {
      const double phi = 2.0 * core::kPi * i / angular_steps;
      sin_phi_.push_back(std::sin(phi));
      cos_phi_.push_back(std::cos(phi));
    }
    for (const cutter::Flute& flute : edges.flutes()) {
      for (int i = 0; i < discs; ++i) {
        const force::EdgeNode node = edges.disc(flute.helix_tangent, discs, i);
        const double behind = flute.helix_tangent * node.lag - flute.position;
        sin_behind_.push_back(std::sin(behind));
        cos_behind_.push_back(std::cos(behind));
        sin_kappa_.push_back(node.sin_kappa);
        cos_kappa_.push_back(node.cos_kappa);
        length_.push_back(node.length / height_);
      }
    }
  }

  /// Forces of one revolution, each array of angular_steps values.
  void revolution(const force::Coefficients& k, double feed_per_tooth, double* x, double* y,
                  double* z) const {
    constexpr int kBlock = 512;
    const force::Coefficients load{feed_per_tooth * k.Ktc * height_,
                                   feed_per_tooth * k.Krc * height_,
                                   feed_per_tooth * k.Kac * height_,
                                   k.Kte * height_,
                                   k.Kre * height_,
                                   k.Kae * height_};
    const int discs = static_cast<int>(sin_behind_.size());
    for (double* row : {x, y, z}) std::fill_n(row, sin_phi_.size(), 0.0);
    for (int from = 0; from < discs; from += kBlock) {
      for (std::size_t i = 0; i < sin_phi_.size(); ++i) {
        const std::array<double, 3> sum = sum_discs(
            &sin_behind_[from], &cos_behind_[from], &sin_kappa_[from], &cos_kappa_[from],
            &length_[from], std::min(kBlock, discs - from), sin_phi_[i], cos_phi_[i], load);
        x[i] += sum[0], y[i] += sum[1], z[i] += sum[2];
      }
    }
  }

 private:
  /// Not inlined, as in force_disc_baseline.h.
  [[gnu::noinline]] static std::array<double, 3> sum_discs(
      const double* __restrict sin_behind, const double* __restrict cos_behind,
      const double* __restrict sin_kappa, const double* __restrict cos_kappa,
      const double* __restrict length, int discs, double sin_phi, double cos_phi,
      force::Coefficients load) {
    // Five sums, so that no addition waits for the one before it.
    double xt = 0.0, xn = 0.0, yt = 0.0, yn = 0.0, z = 0.0;
#pragma omp simd reduction(+ : xt, xn, yt, yn, z)
    for (int d = 0; d < discs; ++d) {
      const double s = sin_phi * cos_behind[d] - cos_phi * sin_behind[d];
      const double c = cos_phi * cos_behind[d] + sin_phi * sin_behind[d];
      const double tangential = s > 0.0 ? load.Ktc * s + load.Kte * length[d] : 0.0;
      const double radial = s > 0.0 ? load.Krc * s + load.Kre * length[d] : 0.0;
      const double axial = s > 0.0 ? load.Kac * s + load.Kae * length[d] : 0.0;
      const double inward = radial * sin_kappa[d] + axial * cos_kappa[d];
      xt -= tangential * c;
      xn -= inward * s;
      yt += tangential * s;
      yn -= inward * c;
      z += radial * cos_kappa[d] - axial * sin_kappa[d];
    }
    return {xt + xn, yt + yn, z};
  }

  double height_;
  std::vector<double> sin_phi_, cos_phi_;        // shape (angular_steps)
  std::vector<double> sin_behind_, cos_behind_;  // shape (flutes, discs)
  std::vector<double> sin_kappa_, cos_kappa_;    // likewise
  std::vector<double> length_;                   // of edge per height, likewise
};

}  // namespace millstudy::baseline
