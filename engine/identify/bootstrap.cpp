// SPDX-License-Identifier: MIT
#include "identify/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <tbb/parallel_for.h>

#include "core/units.h"
#include "identify/fit_steps.h"

namespace millstudy::identify {
namespace {

constexpr std::size_t kFewestParts = 8;
constexpr double kTolerance = 1e-6;  // far below what samples differ by

/// The forces of a record as predicted, and what is left of them.
struct Parts {
  std::array<std::vector<double>, 3> predicted;
  std::array<std::vector<double>, 3> residual;
  std::size_t length = 1;  ///< of what is drawn: a revolution [samples]
};

Parts parts_of(const JointProblem& problem, const std::vector<Record>& records, std::size_t r) {
  Parts parts;
  agreement_of(problem, r, &parts.predicted);
  const Trace& trace = records[r].trace;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < parts.predicted[axis].size(); ++i) {
      parts.residual[axis].push_back(trace.force[axis][i] - parts.predicted[axis][i]);
    }
  }
  const double samples = core::kTurn / problem.states()[r].spindle_speed * trace.sampling_rate;
  // Of few revolutions shorter parts are drawn.
  const std::size_t longest = std::max<std::size_t>(1, trace.size() / kFewestParts);
  parts.length =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::llround(samples)), 1, longest);
  return parts;
}

/// Predicted forces with the residuals of other revolutions, all axes of one from the same.
void resample(const Parts& parts, std::mt19937_64& random, Trace& trace) {
  const std::size_t samples = trace.size();
  const std::size_t length = parts.length;
  const std::size_t starts = samples / length;  // whole ones
  for (std::size_t begin = 0; begin < samples; begin += length) {
    const std::size_t from = random() % starts * length;
    for (std::size_t i = begin; i < std::min(begin + length, samples); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        if (parts.predicted[axis].empty()) continue;
        trace.force[axis][i] = parts.predicted[axis][i] + parts.residual[axis][from + (i - begin)];
      }
    }
  }
}

/// The value below which a part of sorted values lies, by the line between neighbours.
double quantile(const std::vector<double>& sorted, double part) {
  const double place = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double share = place - static_cast<double>(below);
  return (1.0 - share) * sorted[below] + share * sorted[above];
}

}  // namespace

std::vector<std::vector<double>> bootstrap(const cutter::Cutter& cutter,
                                           const std::vector<Record>& records,
                                           const JointProblem& solved, double prior_noise) {
  FitSettings quiet = solved.settings();
  quiet.progress = nullptr;
  quiet.tolerance = std::max(quiet.tolerance, kTolerance);
  std::vector<Parts> parts(records.size());
  tbb::parallel_for(std::size_t{0}, records.size(),
                    [&](std::size_t r) { parts[r] = parts_of(solved, records, r); });
  const auto samples = static_cast<std::size_t>(quiet.bootstrap);
  std::vector<std::vector<double>> found(samples);
  tbb::parallel_for(std::size_t{0}, samples, [&](std::size_t sample) {
    std::seed_seq seeds = {static_cast<std::uint32_t>(quiet.seed),
                           static_cast<std::uint32_t>(sample)};
    std::mt19937_64 random(seeds);
    std::vector<Record> drawn = records;
    for (std::size_t r = 0; r < records.size(); ++r) resample(parts[r], random, drawn[r].trace);
    JointProblem problem(cutter, drawn, quiet, solved.states());
    problem.solve(prior_noise);
    for (const Parameter& p : problem.shared()) {
      found[sample].push_back(value_of(problem.states().front(), p));
    }
  });
  return found;
}

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {std::sqrt(squares / std::max(1.0, n - 1.0)), quantile(values, 0.025),
          quantile(values, 0.975)};
}

}  // namespace millstudy::identify
