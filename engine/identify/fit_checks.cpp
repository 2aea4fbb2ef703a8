// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "core/units.h"
#include "force/engagement.h"
#include "identify/fit_steps.h"
#include "identify/low_pass.h"

namespace millstudy::identify {
namespace {

/// Of one cutter, so that its flutes do not count.
bool same_feed(const std::vector<Record>& records) {
  double low = INFINITY, high = 0.0;
  for (const Record& record : records) {
    const double feed = record.feed_rate * core::kTurn / record.spindle_speed;
    low = std::min(low, feed);
    high = std::max(high, feed);
  }
  return high < 1.05 * low;
}

}  // namespace

void check(const cutter::Cutter& cutter, const std::vector<Record>& records,
           const FitSettings& settings) {
  cutter::check(cutter);
  std::vector<core::Fault> faults;
  const auto fault = [&](std::string text) { faults.push_back({{}, std::move(text)}); };
  if (records.empty()) fault("a fit needs at least one record");
  if (cutter.runout.tilt != 0.0)
    fault("cutter.runout_tilt must be 0: fits know parallel axes only");
  for (const Record& record : records) {
    check(record.trace);
    force::check(cutter, record.engagement);
    if (!(record.feed_rate > 0.0)) fault(record.name + ": feed rate must be > 0");
    if (!(record.spindle_speed > 0.0)) fault(record.name + ": spindle speed must be > 0");
    if (!(record.feed_rate > 0.0 && record.spindle_speed > 0.0)) continue;
    const double turns = static_cast<double>(record.trace.size()) / record.trace.sampling_rate *
                         record.spindle_speed / core::kTurn;
    if (turns < 1.0) {
      fault(fmt::format("{}: {:.2g} revolutions of the spindle; a fit needs at least one",
                        record.name, turns));
    }
    if (settings.below > 0.25 * record.trace.sampling_rate) {
      fault(fmt::format("{}: fit.below_Hz must be at most a quarter of the sampling rate, {} Hz",
                        record.name, 0.25 * record.trace.sampling_rate));
    } else if (settings.below > 0.0 &&
               record.trace.size() <
                   2 * low_pass_length(settings.below, record.trace.sampling_rate)) {
      fault(fmt::format("{}: too short to fit below {} Hz", record.name, settings.below));
    }
    bool measured = false;
    for (int axis = 0; axis < 3; ++axis) {
      measured = measured || (settings.axes[axis] && record.trace.has_axis(axis));
    }
    if (!measured) fault(record.name + ": none of the axes to be fitted was measured");
  }
  if (settings.loss != Loss::none && !(settings.loss_scale > 0.0)) {
    fault("fit.loss_scale_N must be > 0 for this loss");
  }
  if (settings.phase_drift_knots != 0 && settings.phase_drift_knots < 4) {
    fault("fit.phase_drift_knots must be 0 or at least 4");
  }
  if (settings.model == Model::exponential && !(settings.reference_chip_thickness > 0.0)) {
    fault("fit.reference_chip_thickness_mm must be > 0");
  }
  if (settings.phase == Estimated::no && settings.known_phase.size() != records.size()) {
    fault("phase is not estimated, so each record needs a known one");
  }
  for (const Known& known : settings.known) {
    if (known.mean && !(known.deviation.value_or(0.0) > 0.0)) {
      fault("the standard deviation of a prior must be > 0");
    }
  }
  if (!faults.empty()) throw core::InputError(faults);
}

std::vector<std::string> words_on(const std::vector<Record>& records, const FitResult& result,
                                  const std::vector<Parameter>& shared,
                                  const Eigen::VectorXd& weakest) {
  std::vector<std::string> words;
  if (!result.converged) {
    words.push_back(fmt::format("the solver stopped before it converged ({}); values are not final",
                                result.summary));
  }
  // A condition above this loses more than a digit of the coefficients' accuracy (I7).
  constexpr double kIllConditioned = 20.0;
  if (result.condition_number > kIllConditioned && weakest.size() >= 2) {
    std::vector<std::pair<double, std::string>> parts;
    Eigen::Index i = 0;
    for (const Parameter& p : shared) {
      if (p.kind != Parameter::Kind::coefficient || p.index >= 6) continue;
      parts.emplace_back(-std::abs(weakest[i++]), name_of(p));
    }
    std::sort(parts.begin(), parts.end());
    const bool no_z = std::none_of(records.begin(), records.end(), [&](const Record& record) {
      return record.trace.has_axis(2) && result.settings.axes[2];
    });
    std::string next = no_z ? "measure the z force too"
                            : "add records at other feeds, so that chip and edge part separate";
    words.push_back(fmt::format("the records hardly tell {} from {} (condition number {:.0f}): {}",
                                parts[0].second, parts[1].second, result.condition_number, next));
  }
  const std::size_t count = records.size();
  if (result.settings.runout != Estimated::no) {
    std::string at_limit;
    for (std::size_t r = 0; r < count; ++r) {
      const cutter::Runout& runout = result.records[r].runout;
      const double component = std::max(std::abs(runout.offset * std::cos(runout.angle)),
                                        std::abs(runout.offset * std::sin(runout.angle)));
      if (component < 0.99 * result.settings.runout_limit) continue;
      at_limit += (at_limit.empty() ? "" : ", ") + records[r].name;
    }
    if (!at_limit.empty()) {
      words.push_back(fmt::format(
          "{}: the runout is at its limit of {} mm: across the direction in which the teeth differ "
          "it hardly shows; share it between records (fit.shared), or fix it",
          at_limit, result.settings.runout_limit));
    }
  }
  constexpr double kPoor = 0.95;
  const bool poor =
      std::any_of(result.records.begin(), result.records.end(), [](const RecordFit& r) {
        return r.agreement.r_squared[0] < kPoor || r.agreement.r_squared[1] < kPoor;
      });
  if (count >= 3 && !same_feed(records) && (poor || result.settings.below > 0.0)) {
    words.push_back(
        "the model leaves part of the forces out, and the records have several feeds: the "
        "coefficients to use in studies are those of method = \"average\", which depend on neither "
        "dynamometer, phase nor runout");
  }
  if (same_feed(records) && count > 0) {
    words.push_back(
        "all records have one feed: chip and edge coefficients are told apart only by the shape "
        "of the force over a revolution, which a ringing dynamometer or a wrong model bends; "
        "measure three feeds or more");
  }
  return words;
}

}  // namespace millstudy::identify
