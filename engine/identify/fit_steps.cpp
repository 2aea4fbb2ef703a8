// SPDX-License-Identifier: MIT
#include "identify/fit_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>

#include "cutter/flutes.h"
#include "identify/fit_start.h"
#include "identify/low_pass.h"
#include "identify/spindle_speed.h"
#include "identify/uncertainty.h"

namespace millstudy::identify {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Equal flutes may be counted from any: of each record the one that brings the runout nearest to
/// that of the first.
void align_runout(std::vector<RecordState>& states, int flutes) {
  const std::array<double, 2>& first = states.front().runout;
  for (RecordState& state : states) {
    RecordState best = state;
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < flutes; ++k) {
      RecordState turned = state;
      renumber_flutes(turned, flutes, k);
      const double away = std::hypot(turned.runout[0] - first[0], turned.runout[1] - first[1]);
      if (away < nearest) nearest = away, best = turned;
    }
    state = best;
  }
}

}  // namespace

std::vector<RecordState> find_starts(const cutter::Cutter& cutter,
                                     const std::vector<Record>& records,
                                     const FitSettings& settings) {
  std::vector<RecordState> states(records.size());
  tbb::parallel_for(std::size_t{0}, records.size(), [&](std::size_t r) {
    const Record& record = records[r];
    const double speed = settings.spindle_speed == Estimated::no
                             ? record.spindle_speed
                             : estimate_spindle_speed(record.trace, record.spindle_speed).value;
    const double phase = r < settings.known_phase.size() ? settings.known_phase[r] : 0.0;
    states[r] = find_start(cutter, record, settings, phase, speed);
  });
  if (settings.runout == Estimated::shared && settings.phase != Estimated::no &&
      cutter::has_equal_flutes(cutter)) {
    align_runout(states, cutter.flutes);
  }
  for (const Parameter& p : shared_parameters(settings)) {
    std::vector<double> values;
    for (const RecordState& state : states) values.push_back(value_of(state, p));
    const double middle = median(values);
    for (RecordState& state : states) value_of(state, p) = middle;
  }
  return states;
}

Solved solve(const cutter::Cutter& cutter, const std::vector<Record>& records,
             const FitSettings& settings, const std::vector<RecordState>& starts) {
  FitSettings simpler = settings;
  simpler.phase_drift_knots = 0;
  simpler.estimate_dynamometer = false;
  simpler.tolerance = std::max(1e-4, settings.tolerance);  // only where the next begins
  std::vector<RecordState> states = starts;
  const bool in_steps = settings.phase_drift_knots > 0 || settings.estimate_dynamometer;
  const bool drifts_already =
      std::any_of(starts.begin(), starts.end(), [](const RecordState& state) {
        return std::any_of(state.phase_drift.begin(), state.phase_drift.end(),
                           [](double x) { return x != 0.0; });
      });
  if (in_steps && !drifts_already) {
    JointProblem first(cutter, records, simpler, states);
    first.solve();
    states = first.states();
  }
  Solved solved{JointProblem(cutter, records, settings, states), {}, 0.0};
  solved.outcome = solved.problem.solve();
  const bool priors = std::any_of(settings.known.begin(), settings.known.end(),
                                  [](const Known& known) { return known.mean.has_value(); });
  if (priors) {
    const Uncertainty rough = uncertainty(solved.problem, 0.0);
    const double correlation = std::clamp(rough.correlation, 0.0, 0.999);
    solved.prior_noise = rough.noise * std::sqrt((1.0 + correlation) / (1.0 - correlation));
    const int before = solved.outcome.iterations;
    solved.outcome = solved.problem.solve(solved.prior_noise);
    solved.outcome.iterations += before;
  }
  return solved;
}

Agreement agreement_of(const JointProblem& problem, std::size_t record,
                       std::array<std::vector<double>, 3>* predicted) {
  const RecordModel& model = problem.model(record);
  const std::vector<int>& axes = model.axes();
  const Trace& trace = model.record().trace;
  std::array<std::vector<double>, 3> forces;
  for (const int axis : axes) forces[axis].reserve(model.samples());
  model.for_each_sample(problem.states()[record], {}, [&](Stretch& stretch) {
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const auto part = stretch.predicted.segment(static_cast<Eigen::Index>(a) * stretch.samples,
                                                  stretch.samples);
      forces[axes[a]].insert(forces[axes[a]].end(), part.begin(), part.end());
    }
  });
  Agreement out{{kUnknown, kUnknown, kUnknown}, {kUnknown, kUnknown, kUnknown}};
  const double below = problem.settings().below;  // what is compared is what was fitted
  for (const int axis : axes) {
    const auto compared = [&](const std::vector<double>& signal) {
      return below > 0.0 ? low_pass(signal, below, trace.sampling_rate) : signal;
    };
    const std::vector<double> measured = compared(trace.force[axis]);
    const std::vector<double> modelled = compared(forces[axis]);
    const double count = static_cast<double>(measured.size());
    double mean = 0.0, squares = 0.0, total = 0.0;
    for (const double f : measured) mean += f / count;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      squares += (modelled[i] - measured[i]) * (modelled[i] - measured[i]);
      total += (measured[i] - mean) * (measured[i] - mean);
    }
    out.rmse[axis] = std::sqrt(squares / count);
    out.r_squared[axis] = total > 0.0 ? 1.0 - squares / total : kUnknown;
  }
  if (predicted != nullptr) *predicted = std::move(forces);
  return out;
}

LeaveOneOut leave_one_out(const cutter::Cutter& cutter, const std::vector<Record>& records,
                          const FitSettings& settings, const std::vector<RecordState>& solved) {
  const std::size_t count = records.size();
  FitSettings quiet = settings;
  quiet.progress = nullptr;
  LeaveOneOut out{std::vector<std::vector<double>>(count), std::vector<Agreement>(count), 0.0};
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t r) {
    std::vector<Record> others;
    std::vector<RecordState> states;
    for (std::size_t i = 0; i < count; ++i) {
      if (i == r) continue;
      others.push_back(records[i]);
      states.push_back(solved[i]);
    }
    const Solved without = solve(cutter, others, quiet, states);
    const RecordState& found = without.problem.states().front();
    RecordState state = solved[r];
    for (const Parameter& p : without.problem.shared()) {
      out.shared[r].push_back(value_of(found, p));
      value_of(state, p) = value_of(found, p);
    }
    const std::vector<Record> one = {records[r]};
    FitSettings alone = quiet;
    alone.weigh_records_alike = false;
    JointProblem predicted(cutter, one, alone, {state});
    predicted.keep_shared();
    predicted.solve();
    out.agreement[r] = agreement_of(predicted, 0);
  });
  // Residual over total sum of squares, of all axes and records.
  double squares = 0.0, total = 0.0;
  for (std::size_t r = 0; r < count; ++r) {
    double record_squares = 0.0, record_total = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double rmse = out.agreement[r].rmse[axis];
      if (!std::isfinite(rmse)) continue;
      const double samples = static_cast<double>(records[r].trace.size());
      record_squares += samples * rmse * rmse;
      record_total += samples * rmse * rmse / (1.0 - out.agreement[r].r_squared[axis]);
    }
    const double weight = settings.weigh_records_alike ? 1.0 / record_total : 1.0;
    squares += weight * record_squares;
    total += weight * record_total;
  }
  out.prediction_error = std::sqrt(squares / total);
  return out;
}

}  // namespace millstudy::identify
