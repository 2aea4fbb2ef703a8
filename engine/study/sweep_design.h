// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/value.h"
#include "study/faults.h"
#include "sweep/parameter_space.h"

namespace millstudy::study {

/// How the axes of a sweep are combined; of sampled designs, where each point stands on them.
struct SweepDesign {
  sweep::Design design = sweep::Design::grid;
  std::int64_t samples = 0;
  std::int64_t seed = 1;
  std::size_t axes = 0;  ///< of the sweep

  bool is_sampled() const;
  /// Dimensions that the Sobol' sequence needs for these axes; 0: another design.
  std::size_t sobol_dimensions() const;
  /// For the study hash, of one axis: "sobol 1024 samples, seed 1, dimension 2,".
  std::string how(std::size_t axis) const;
  /// Place of each point on an axis, > 0 and < 1; shape (samples), saltelli (samples (axes + 2)).
  std::vector<double> places(std::size_t axis) const;
};

/// Name of a design in the study file.
std::string_view name_of(sweep::Design design);

/// Reads design, samples and seed of [sweep].
/// @param axes   how many the sweep has
/// @param notes  what the user should hear of
SweepDesign read_design(const core::Value& section, std::size_t axes,
                        std::vector<core::Fault>& notes, Faults& faults);

}  // namespace millstudy::study
