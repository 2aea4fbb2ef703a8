// SPDX-License-Identifier: MIT
#include "dynamics/floquet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "core/error.h"
#include "core/units.h"
#include "dynamics/arnoldi.h"
#include "dynamics/collocation.h"
#include "dynamics/semi_discretization.h"

namespace millstudy::dynamics {
namespace {

constexpr int kHarmonics = 40;
constexpr double kWild = 1e3;  // nobody needs digits of larger radii

/// Each has an error some tens of times below that of the one before.
constexpr std::array<Collocation, kLevels> kLadder = {{{5, 5.0},
                                                       {6, 4.0},
                                                       {8, 4.0},
                                                       {10, 4.0},
                                                       {12, 4.0},
                                                       {16, 4.0},
                                                       {16, 2.0},
                                                       {16, 1.0},
                                                       {16, 0.5}}};

void set_multiplier(Floquet& result, std::complex<double> value) {
  result.multiplier = value;
  result.chatter_frequency = std::numeric_limits<double>::quiet_NaN();
  result.spectral_radius = std::abs(value);
  result.kind = bifurcation(value);
}

/// Frequencies of the harmonics by their amplitude, of which the largest axis counts.
template <class Spectrum>
void set_frequencies(Floquet& result, const Spectrum& spectrum_of_motion, double period) {
  if (result.spectral_radius >= kLargestGrowth) return;
  const Eigen::MatrixXcd spectrum = spectrum_of_motion();
  const Eigen::Index count = spectrum.cols(), middle = count / 2;
  const double own = std::arg(result.multiplier) / period;
  std::vector<std::pair<double, double>> all;  // amplitude, frequency
  for (Eigen::Index k = 0; k < count; ++k) {
    const double frequency = std::abs(own + core::kTurn * static_cast<double>(k - middle) / period);
    const double amplitude = spectrum.col(k).cwiseAbs().maxCoeff();
    // A real motion has each frequency twice.
    const auto same = std::find_if(all.begin(), all.end(), [&](const auto& other) {
      return std::abs(other.second - frequency) < 1e-6 / period;
    });
    if (same == all.end())
      all.push_back({amplitude, frequency});
    else
      same->first += amplitude;
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [amplitude, frequency] : all) {
    if (amplitude >= 0.1 * all.front().first) result.frequencies.push_back(frequency);
  }
  result.chatter_frequency = result.frequencies.front();
}

/// The same from equally spaced samples.
Eigen::MatrixXcd spectrum_of(const Eigen::MatrixXcd& motion, std::complex<double> multiplier) {
  const Eigen::Index count = motion.cols();
  const Eigen::Index harmonics = std::min<Eigen::Index>(kHarmonics, (count - 1) / 2);
  Eigen::MatrixXcd all = Eigen::MatrixXcd::Zero(motion.rows(), 2 * harmonics + 1);
  const auto samples = static_cast<double>(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / samples;
    const std::complex<double> turn = std::polar(1.0, -core::kTurn * share);
    std::complex<double> factor =
        std::exp(-std::log(multiplier) * share) *
        std::polar(1.0 / samples, core::kTurn * static_cast<double>(harmonics) * share);
    for (Eigen::Index k = 0; k <= 2 * harmonics; ++k, factor *= turn) {
      all.col(k) += factor * motion.col(i);
    }
  }
  return all;
}

Floquet by_intervals(const DelaySystem& system, const FloquetSettings& settings) {
  const SemiDiscretizedMap map(system, {settings.intervals, settings.order});
  ArnoldiSettings arnoldi;
  arnoldi.tolerance = 1e-10;  // far below what intervals leave
  const DominantEigenvalue found = dominant_eigenvalue(map.map(), arnoldi);
  if (!found.converged) throw core::CaseError("the dominant multiplier did not converge");
  Floquet result;
  set_multiplier(result, found.value);
  if (!settings.frequencies) return result;
  const auto spectrum = [&] { return spectrum_of(map.motion(found.vector), found.value); };
  set_frequencies(result, spectrum, system.period);
  return result;
}

DominantEigenvalue dominant_at(const CollocationMap& map, const Eigen::VectorXd& guess,
                               double tolerance) {
  ArnoldiSettings settings;
  settings.tolerance = tolerance;
  settings.start = guess;
  DominantEigenvalue found = dominant_eigenvalue(map.map(), settings);
  if (!found.converged) throw core::CaseError("the dominant multiplier did not converge");
  return found;
}

}  // namespace

Bifurcation bifurcation(std::complex<double> multiplier) {
  if (std::abs(multiplier.imag()) > 1e-6 * std::abs(multiplier)) return Bifurcation::hopf;
  return multiplier.real() < 0.0 ? Bifurcation::flip : Bifurcation::fold;
}

Floquet floquet(const DelaySystem& system, const FloquetSettings& settings, int first_level) {
  if (settings.intervals > 0) return by_intervals(system, settings);
  if (!(settings.tolerance >= 1e-12 && settings.tolerance <= 0.1)) {
    throw core::InputError(
        fmt::format("tolerance = {} must be between 1e-12 and 0.1", settings.tolerance));
  }
  const double residual = std::clamp(1e-2 * settings.tolerance, 1e-13, 1e-6);
  Floquet result;
  int level = std::clamp(first_level, 0, kLevels - 2);
  const CollocationMap first(system, kLadder[level]);
  double before = std::abs(dominant_at(first, {}, residual).value);
  while (++level < kLevels) {
    const CollocationMap map(system, kLadder[level]);
    const DominantEigenvalue found = dominant_at(map, {}, residual);
    set_multiplier(result, found.value);
    result.error = std::abs(result.spectral_radius - before) / result.spectral_radius;
    if (result.error <= 0.1 * settings.tolerance || result.error < 1e-12) {
      result.level = level - 1;
      if (!settings.frequencies) return result;
      const auto spectrum = [&] { return map.spectrum(found.vector, found.value, kHarmonics); };
      set_frequencies(result, spectrum, system.period);
      return result;
    }
    before = result.spectral_radius;
  }
  if (std::min(before, result.spectral_radius) < kWild) {
    throw core::CaseError("the spectral radius did not reach the tolerance");
  }
  result.level = kLevels - 2;
  return result;
}

RadiusAtLevel radius_at_level(const DelaySystem& system, int level, double residual,
                              const Eigen::VectorXd& guess) {
  const CollocationMap map(system, kLadder[std::clamp(level, 0, kLevels - 1)]);
  const DominantEigenvalue found = dominant_at(map, guess, residual);
  return {std::abs(found.value), found.vector.real() + found.vector.imag()};
}

}  // namespace millstudy::dynamics
