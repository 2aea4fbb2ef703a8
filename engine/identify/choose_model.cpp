// SPDX-License-Identifier: MIT
#include "identify/choose_model.h"

#include <algorithm>
#include <fmt/core.h>

#include "core/error.h"

namespace millstudy::identify {

std::string name_of(Model model) {
  switch (model) {
    case Model::constant:
      return "constant";
    case Model::per_height:
      return "per_height";
    case Model::exponential:
      break;
  }
  return "exponential";
}

ModelChoice choose_model(const cutter::Cutter& cutter, const std::vector<Record>& records,
                         const FitSettings& settings) {
  if (records.size() < 3) {
    throw core::InputError(
        "a model can be chosen by left-out records from three records on: give more, or "
        "fit.model = \"constant\"");
  }
  constexpr double kBetter = 0.99;
  ModelChoice choice;
  bool any = false;
  for (const Model model : {Model::constant, Model::exponential, Model::per_height}) {
    FitSettings tried = settings;
    tried.model = model;
    FitResult result = fit(cutter, records, tried);
    choice.trials.push_back({model, result.prediction_error});
    if (any && !(result.prediction_error < kBetter * choice.best.prediction_error)) continue;
    choice.best = std::move(result);
    any = true;
  }
  std::string errors;
  for (const Trial& trial : choice.trials) {
    errors += fmt::format("{}{} {:.2f} %", errors.empty() ? "" : ", ", name_of(trial.model),
                          100.0 * trial.prediction_error);
  }
  const bool preferred = std::any_of(
      choice.trials.begin(), choice.trials.end(),
      [&](const Trial& trial) { return trial.prediction_error < choice.best.prediction_error; });
  choice.reason = fmt::format(
      "model {} was chosen: {} (error over the scatter of the forces: {})",
      name_of(choice.best.settings.model),
      preferred ? "no more complicated one predicts left-out records better by a hundredth"
                : "it predicts left-out records best",
      errors);
  return choice;
}

}  // namespace millstudy::identify
