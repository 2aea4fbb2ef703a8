// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "identify/fit.h"

namespace millstudy::identify {

/// "constant", "per_height" or "exponential".
std::string name_of(Model model);

/// What choose_model() tried.
struct Trial {
  Model model = Model::constant;
  double prediction_error = 0.0;  ///< of records left out
};

struct ModelChoice {
  FitResult best;
  std::vector<Trial> trials;
  std::string reason;  ///< in a sentence
};

/// Fits every model and takes the one that predicts left-out records best, (I9); a more complicated
/// one only if it is better by more than a hundredth.
///
/// @throws core::InputError as fit(), and for fewer than three records
ModelChoice choose_model(const cutter::Cutter& cutter, const std::vector<Record>& records,
                         const FitSettings& settings);

}  // namespace millstudy::identify
