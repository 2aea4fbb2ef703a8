// SPDX-License-Identifier: MIT
#include "identify/fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <utility>

#include "core/units.h"
#include "identify/bootstrap.h"
#include "identify/fit_steps.h"
#include "identify/student.h"
#include "identify/uncertainty.h"

namespace millstudy::identify {
namespace {

/// Wall time since the last lap.
class Clock {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

RecordFit record_fit(const JointProblem& problem, std::size_t r) {
  const RecordModel& model = problem.model(r);
  const RecordState& state = problem.states()[r];
  const double last = static_cast<double>(model.samples() - 1);
  RecordFit out;
  const double angle = model.angle_at(state, 0.0);
  out.phase = angle - core::kTurn * std::floor(angle / core::kTurn);
  out.spindle_speed = state.spindle_speed;
  out.feed_per_tooth = model.feed_per_tooth(state.spindle_speed);
  out.runout.offset = std::hypot(state.runout[0], state.runout[1]);
  out.runout.angle = std::atan2(state.runout[1], state.runout[0]);
  out.offset = state.offset;
  out.drift = state.drift;
  const auto knots = static_cast<int>(state.phase_drift.size());
  RecordState even = state;
  even.phase_drift.clear();
  for (int i = 0; i < knots; ++i) {
    const double sample = last * i / (knots - 1);
    out.phase_drift.push_back(model.angle_at(state, sample) - model.angle_at(even, sample));
  }
  out.agreement = agreement_of(problem, r, &out.predicted);
  return out;
}

Estimate estimate_of(const Parameter& p, int record, const RecordState& state, double error,
                     double naive) {
  Estimate out;
  const double factor = factor_of(p);
  out.name = name_of(p);
  out.unit = unit_of(p);
  out.record = record;
  out.value = factor * value_of(state, p);
  out.standard_error = factor * error;
  out.naive_error = factor * naive;
  return out;
}

void set_interval(Estimate& estimate, double error, double degrees_of_freedom) {
  const double half = student_975(degrees_of_freedom) * error;
  estimate.confidence_low = estimate.value - half;
  estimate.confidence_high = estimate.value + half;
}

/// 99.9 % point of chi-squared over its degrees of freedom (Wilson and Hilferty), 2 % high at 2.
double chi_squared_999(double n) {
  const double part = 2.0 / (9.0 * n);
  return std::pow(1.0 - part + 3.090 * std::sqrt(part), 3);
}

}  // namespace

FitResult fit(const cutter::Cutter& cutter, const std::vector<Record>& records,
              const FitSettings& settings) {
  check(cutter, records, settings);
  FitResult result;
  result.settings = settings;
  Clock clock;
  const std::vector<RecordState> starts = find_starts(cutter, records, settings);
  result.start_seconds = clock.lap();
  const Solved solved = solve(cutter, records, settings, starts);
  result.solve_seconds = clock.lap();
  const JointProblem& problem = solved.problem;
  const Uncertainty sure = uncertainty(problem, solved.prior_noise);

  result.converged = solved.outcome.converged;
  result.iterations = solved.outcome.iterations;
  result.cost = solved.outcome.cost;
  result.summary = solved.outcome.summary;
  const RecordState& state = problem.states().front();
  const std::array<double, 12>& k = state.coefficients.k;
  result.coefficients = {k[0], k[1], k[2], k[3], k[4], k[5]};
  std::copy_n(k.begin() + 6, 6, result.height_slope.begin());
  result.size_exponent = state.coefficients.size_exponent;
  result.dynamometer = state.dynamometer;
  result.condition_number = sure.condition_number;

  const std::vector<Parameter>& shared = problem.shared();
  const auto count = static_cast<Eigen::Index>(shared.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    Estimate e = estimate_of(shared[i], -1, state, std::sqrt(sure.shared_covariance(i, i)),
                             sure.shared_naive[i]);
    set_interval(e, e.standard_error, sure.degrees_of_freedom);
    result.estimates.push_back(std::move(e));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double scale = factor_of(shared[i]) * factor_of(shared[j]);
      const double c = sure.shared_covariance(i, j);
      result.covariance.push_back(scale * c);
      result.correlation.push_back(
          c / std::sqrt(sure.shared_covariance(i, i) * sure.shared_covariance(j, j)));
    }
  }
  for (std::size_t r = 0; r < records.size(); ++r) {
    for (std::size_t i = 0; i < problem.own().size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      Estimate e = estimate_of(problem.own()[i], static_cast<int>(r), problem.states()[r],
                               sure.own_error[r][at], sure.own_naive[r][at]);
      set_interval(e, e.standard_error, sure.degrees_of_freedom);
      result.estimates.push_back(std::move(e));
    }
    result.records.push_back(record_fit(problem, r));
  }

  if (records.size() >= 3) {
    const LeaveOneOut left = leave_one_out(cutter, records, settings, problem.states());
    result.left_out = left.agreement;
    result.prediction_error = left.prediction_error;
    const double n = static_cast<double>(records.size());
    bool model_error = false;
    for (std::size_t i = 0; i < shared.size(); ++i) {
      double mean = 0.0, squares = 0.0;
      for (const std::vector<double>& values : left.shared) mean += values[i] / n;
      for (const std::vector<double>& values : left.shared) {
        squares += (values[i] - mean) * (values[i] - mean);
      }
      Estimate& e = result.estimates[i];
      e.jackknife_error = factor_of(shared[i]) * std::sqrt((n - 1.0) / n * squares);
      if (std::pow(e.jackknife_error / e.standard_error, 2) > chi_squared_999(n - 1.0)) {
        model_error = true;
        set_interval(e, e.jackknife_error, n - 1.0);
      }
    }
    if (model_error) {
      result.warnings.push_back(
          "records disagree by more than their noise: no one set of these parameters describes "
          "them all; the intervals are those of the jackknife over records");
    }
  }
  if (settings.bootstrap > 0) {
    const auto samples = bootstrap(cutter, records, problem, solved.prior_noise);
    for (std::size_t i = 0; i < shared.size(); ++i) {
      std::vector<double> values;
      for (const std::vector<double>& sample : samples) values.push_back(sample[i]);
      const Spread found = spread(std::move(values));
      const double factor = factor_of(shared[i]);
      Estimate& e = result.estimates[i];
      e.bootstrap_error = factor * found.deviation;
      e.bootstrap_low = factor * found.low;
      e.bootstrap_high = factor * found.high;
    }
  }
  result.error_seconds = clock.lap();
  for (std::string& words : words_on(records, result, shared, sure.weakest)) {
    result.warnings.push_back(std::move(words));
  }
  return result;
}

}  // namespace millstudy::identify
