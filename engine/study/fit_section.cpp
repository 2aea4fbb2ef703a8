// SPDX-License-Identifier: MIT
// [fit]: the method, what is estimated, and how.
#include <algorithm>
#include <cctype>
#include <fmt/format.h>

#include "study/fit_reader.h"

namespace millstudy::study {
namespace {

bool has(const std::vector<std::string>& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// A regression of means has no use for these, and would give another answer than was asked for.
void check_average(FitReader& read, const core::Value& fit) {
  if (read.file.method != FitMethod::average) return;
  for (const char* name : {"model", "axes", "weights", "loss", "below_Hz", "fixed", "prior"}) {
    if (const core::Value* given = fit.find(name)) {
      read.faults.add(given->place,
                      fmt::format("fit.{} is for method = \"instantaneous\" only", name));
    }
  }
}

void check_name(FitReader& read, const core::Place& name_place) {
  const std::string& name = read.file.name;
  const bool fine = !name.empty() && name.size() <= 100 && name.front() != '.' &&
                    std::all_of(name.begin(), name.end(), [](char c) {
                      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' ||
                             c == '.' || c == '+';
                    });
  if (fine || name_place.line == 0) return;
  read.faults.add(
      name_place,
      fmt::format("fit.name = \"{}\" names the result file: use 1 to 100 letters, digits, "
                  "_ - + and dots inside",
                  name));
}

void read_known(FitReader& read, bool fixed, const core::Value& table) {
  const std::string prefix = fixed ? "fit.fixed." : "fit.prior.";
  for (const core::Member& member : table.table()) {
    read.faults.collect([&] {
      const auto at = std::find(kCoefficientKeys.begin(), kCoefficientKeys.end(), member.key);
      if (at == kCoefficientKeys.end()) {
        throw core::InputError(member.value.place,
                               fmt::format("{}{} is not one of {}{}", prefix, member.key,
                                           fmt::join(kCoefficientKeys, ", "),
                                           suggestion(member.key, kCoefficientKeys)));
      }
      identify::Known& known = read.file.settings.known[at - kCoefficientKeys.begin()];
      if (fixed) {
        known.fixed = finite_number(member.value, prefix + member.key);
        return;
      }
      const core::Value* mean = member.value.find("mean");
      const core::Value* deviation = member.value.find("deviation");
      if (!mean || !deviation || member.value.table().size() != 2) {
        throw core::InputError(
            member.value.place,
            fmt::format("{}{} must be {{ mean = ..., deviation = ... }}", prefix, member.key));
      }
      known.mean = finite_number(*mean, prefix + member.key + ".mean");
      known.deviation = finite_number(*deviation, prefix + member.key + ".deviation");
      if (!(*known.deviation > 0.0)) {
        throw core::InputError(deviation->place,
                               fmt::format("{}{}.deviation must be > 0", prefix, member.key));
      }
    });
  }
}

}  // namespace

core::Place read_fit_section(FitReader& read) {
  const core::Value* fit = read.section("fit");
  if (!fit) {
    if (!read.root.find("fit"))
      read.faults.add(read.whole(), "[fit] is missing: the method and what is estimated");
    return read.whole();
  }
  std::vector<std::string> estimate = {"phase", "spindle_speed", "runout", "offset"}, shared;
  core::Place name_place;
  int knots = 60;
  identify::FitSettings& s = read.file.settings;
  const core::Value* estimate_value = fit;
  read.for_each_key(*fit, "fit", [&](const Key& key, const core::Value& value) {
    const std::string_view name = key.name();
    if (key.type == KeyType::table) return read_known(read, name == "fixed", as_table(key, value));
    if (key.type == KeyType::choices) {
      const std::vector<std::string> list = words(key, value);
      if (name == "estimate") estimate = list, estimate_value = &value;
      if (name == "shared") shared = list;
      if (name == "axes") {
        for (int axis = 0; axis < 3; ++axis) s.axes[axis] = has(list, kAxisNames[axis]);
      }
      return;
    }
    const Setting setting = checked_setting(key, value);
    const auto* number = std::get_if<double>(&setting);
    const auto* text = std::get_if<std::string>(&setting);
    if (name == "name") read.file.name = *text, name_place = value.place;
    if (name == "description") read.file.description = *text;
    if (name == "method" && *text == "average") read.file.method = FitMethod::average;
    if (name == "model") {
      read.file.choose_model = *text == "auto";
      if (*text == "per_height") s.model = identify::Model::per_height;
      if (*text == "exponential") s.model = identify::Model::exponential;
    }
    if (name == "weights") s.weigh_records_alike = *text == "records";
    if (name == "loss" && *text == "huber") s.loss = identify::Loss::huber;
    if (name == "loss" && *text == "cauchy") s.loss = identify::Loss::cauchy;
    if (name == "loss_scale_N") s.loss_scale = *number;
    if (name == "phase_drift_knots") knots = static_cast<int>(*number);
    if (name == "runout_limit_mm") s.runout_limit = *number;
    if (name == "reference_chip_thickness_mm") s.reference_chip_thickness = *number;
    if (name == "below_Hz") s.below = *number;
    if (name == "tolerance") s.tolerance = *number;
    if (name == "bootstrap") s.bootstrap = static_cast<int>(*number);
    if (name == "seed") s.seed = static_cast<int>(*number);
    if (name == "max_iterations") s.max_iterations = static_cast<int>(*number);
  });
  if (!fit->find("name")) read.miss("fit.name");
  check_name(read, name_place);
  check_average(read, *fit);
  if (s.loss != identify::Loss::none && !(s.loss_scale > 0.0) && !fit->find("loss_scale_N")) {
    read.faults.add(fit->find("loss")->place,
                    "fit.loss needs fit.loss_scale_N, the residual from which it counts less");
  }
  const auto treated = [&](std::string_view word) {
    return !has(estimate, word) ? identify::Estimated::no
           : has(shared, word)  ? identify::Estimated::shared
                                : identify::Estimated::per_record;
  };
  for (const std::string& word : shared) {
    if (!has(estimate, word)) {
      read.faults.add(fit->find("shared")->place,
                      fmt::format("fit.shared holds {}, which fit.estimate does not", word));
    }
  }
  s.phase = treated("phase");
  s.spindle_speed = treated("spindle_speed");
  s.runout = treated("runout");
  s.offset = treated("offset");
  s.drift = treated("drift");
  s.phase_drift_knots = has(estimate, "phase_drift") ? knots : 0;
  s.estimate_dynamometer = has(estimate, "dynamometer");
  return estimate_value->place;
}

}  // namespace millstudy::study
