// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/delay_system.h"

namespace millstudy::dynamics {

/// How a dominant multiplier leaves the unit circle.
enum class Bifurcation {
  hopf,  ///< a complex pair: chatter at a frequency of its own
  flip,  ///< at -1: chatter at odd multiples of half the frequency of the period
  fold,  ///< at +1: no chatter of its own, the cut itself is unstable
};

/// Of a multiplier; real ones are told by an angle below 1e-6 rad.
Bifurcation bifurcation(std::complex<double> multiplier);

/// How a multiplier is computed.
struct FloquetSettings {
  /// Relative error of the spectral radius, kept by estimate: collocation of rising order until
  /// two differ by less than a tenth of this. From 1e-12.
  double tolerance = 1e-3;
  int intervals = 0;        ///< if > 0: semi-discretization with so many instead
  int order = 0;            ///< of the semi-discretization, 0 .. 2
  bool frequencies = true;  ///< without, those of chatter are not looked for
};

/// What a period of the cut makes of a small disturbance.
struct Floquet {
  std::complex<double> multiplier;  ///< of largest modulus, imaginary part >= 0
  double spectral_radius = 0.0;     ///< its modulus [1]: stable below 1; 1e100 and all above
  Bifurcation kind = Bifurcation::hopf;
  double chatter_frequency = 0.0;   ///< of the strongest harmonic [rad/s]; NaN at radius 1e100
  std::vector<double> frequencies;  ///< of the harmonics, strongest first, to 10 % of it [rad/s]
  double error = 0.0;               ///< estimated, relative; 0 with given intervals
  int level = 0;                    ///< of the ladder of orders, for a next point to begin at
};

/// (D13): the dominant multiplier of a system and the chatter that belongs to it.
///
/// Measured, tolerance 1e-3 and 1e-6, on 200 random cuts: within the tolerance of a run at 1e-9.
/// Throws core::InputError for settings out of range, core::CaseError where no order is enough; a
/// radius above 1e3 is then returned as it is, with its error and without frequency.
/// @param first_level  of the ladder, that of a neighbouring point
Floquet floquet(const DelaySystem& system, const FloquetSettings& settings, int first_level = 0);

/// Spectral radius alone, at one level of the ladder and without estimate of its error.
/// @param residual  of the eigenvalue, relative
struct RadiusAtLevel {
  double value = 0.0;
  Eigen::VectorXd vector;  ///< a guess for a neighbouring point
};
RadiusAtLevel radius_at_level(const DelaySystem& system, int level, double residual,
                              const Eigen::VectorXd& guess = {});

/// Levels of the ladder.
inline constexpr int kLevels = 9;

}  // namespace millstudy::dynamics
