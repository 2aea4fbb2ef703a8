// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
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

  bool is_sampled() const;
  /// For the study hash, of one axis: "sobol 1024 samples, seed 1, dimension 2,".
  std::string how(std::size_t axis) const;
  /// Place of each point on an axis, > 0 and < 1; shape (samples).
  std::vector<double> places(std::size_t axis) const;
};

/// Reads design, samples and seed of [sweep].
/// @param notes  what the user should hear of
SweepDesign read_design(const core::Value& section, std::vector<core::Fault>& notes,
                        Faults& faults);

}  // namespace millstudy::study
