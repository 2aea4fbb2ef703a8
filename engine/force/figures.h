// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "force/sampler.h"
#include "force/spectrum.h"
#include "force/statistics.h"

namespace millstudy::force {

/// What to measure of a force history besides what is always measured.
struct FigureRequest {
  int harmonics = 0;                     ///< of the tooth-passing frequency, from the first
  bool flutes = false;                   ///< each flute by itself
  std::optional<double> stick_out = {};  ///< from the tip to the holder [mm]: bending moment
};

/// What one flute does.
struct FluteFigures {
  double chip_thickness_max = 0.0;  ///< [mm]
  double load_share = 0.0;          ///< its part of the mean torque [1]
};

/// What is measured of a force history.
struct ForceFigures {
  ForceStatistics statistics = {};
  double chip_thickness_max = 0.0;  ///< [mm]
  double bending_moment_max = 0.0;  ///< at the holder [N mm]; 0 where not asked for
  std::array<std::vector<double>, kRows> harmonics = {};  ///< of x, y, z [N], torque [N mm]; shape
                                                          ///< (4, harmonics)
  std::vector<FluteFigures> flutes = {};  ///< shape (N), or empty where not asked for
};

/// Takes in a force history piece by piece, as a sampler makes it, and measures it.
///
/// The order of summation is fixed by the pieces alone, so equal pieces give equal bits.
class FigureAccumulator {
 public:
  /// @param sampler  with moments if the request has a stick-out
  /// Throws core::InputError for more harmonics than the samples resolve.
  FigureAccumulator(const FigureRequest& request, const ForceSampler& sampler);

  /// Takes in samples first .. first + count - 1, which the sampler has made of these arguments.
  void add(const ForceSampler& sampler, const Coefficients& coefficients, const Feed& feed,
           std::int64_t first, std::int64_t count, const ForceSamples& samples);

  ForceFigures result() const;

 private:
  /// What a chip is thickest with: the advance along the thickest radius, f sin(phi), and upward.
  struct Advance {
    double radial;  ///< [mm]
    double upward;  ///< [mm]
  };
  void add_bending(const ForceSampler& sampler, const Coefficients& coefficients, const Feed& feed,
                   std::int64_t first, std::int64_t count, const ForceSamples& samples);
  void note_advance(const Advance& advance);
  void add_flutes(const ForceSampler& sampler, const Coefficients& coefficients, const Feed& feed,
                  std::int64_t first, std::int64_t count);

  FigureRequest request_;
  ForceSampler sampler_;
  StatisticsAccumulator statistics_;
  std::optional<Spectrum> spectrum_;
  double bending_square_ = 0.0;
  std::vector<double> flute_torque_;  ///< sums [N mm]
  ForceSamples buffer_;
  std::vector<Advance> advances_;  ///< of which none has both less radial and more upward advance
};

}  // namespace millstudy::force
