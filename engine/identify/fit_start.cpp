// SPDX-License-Identifier: MIT
#include "identify/fit_start.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tbb/parallel_for.h>

#include "core/units.h"
#include "cutter/flutes.h"
#include "identify/joint_problem.h"
#include "identify/synchronous_average.h"

namespace millstudy::identify {
namespace {

/// A phase and the coefficients that fit it best.
struct Candidate {
  double phase;
  double squares;  ///< what they leave [N2]
  std::array<double, 6> k;
};

/// (I3): least squares of the coefficients and offsets at every phase of a revolution.
class PhaseScan {
 public:
  PhaseScan(const cutter::Cutter& cutter, const Record& turn, const FitSettings& settings)
      : bins_(static_cast<int>(turn.trace.size())), turn_(turn), settings_(settings) {
    for (int axis = 0; axis < 3; ++axis) {
      if (settings.axes[axis] && turn.trace.has_axis(axis)) axes_.push_back(axis);
    }
    force::ForceSensitivity kernel(cutter, turn.engagement, {});
    const double feed = turn.feed_rate * core::kTurn / (turn.spindle_speed * cutter.flutes);
    for (int i = 0; i < bins_; ++i) {
      const force::Sensitivity at = kernel.at(core::kTurn * i / bins_, feed, {});
      table_.push_back(at.coefficient);
    }
  }

  /// @param shift  bins by which the phase is ahead
  Candidate at(int shift) const {
    const auto offsets = static_cast<int>(settings_.offset == Estimated::no ? 0 : axes_.size());
    Eigen::MatrixXd a(bins_ * static_cast<int>(axes_.size()), 6 + offsets);
    Eigen::VectorXd b(a.rows());
    a.setZero();
    for (std::size_t q = 0; q < axes_.size(); ++q) {
      for (int i = 0; i < bins_; ++i) {
        const auto row = static_cast<Eigen::Index>(q) * bins_ + i;
        b[row] = turn_.trace.force[axes_[q]][i];
        const auto& columns = table_[(i + shift) % bins_];
        for (int c = 0; c < 6; ++c) {
          if (settings_.known[c].fixed) {
            b[row] -= *settings_.known[c].fixed * columns[c][axes_[q]];
          } else {
            a(row, c) = columns[c][axes_[q]];
          }
        }
        if (offsets > 0) a(row, 6 + static_cast<Eigen::Index>(q)) = 1.0;
      }
    }
    Eigen::VectorXd scale = a.colwise().norm();
    for (double& s : scale) s = s > 0.0 ? s : 1.0;
    a *= scale.cwiseInverse().asDiagonal();
    Eigen::MatrixXd gram = a.transpose() * a;
    gram.diagonal().array() += 1e-12;  // columns that are alike, or empty, share and stay small
    const Eigen::VectorXd x = gram.ldlt().solve(a.transpose() * b);
    Candidate candidate{
        core::kTurn * (shift + 0.5 * (bins_ - 1)) / bins_, (b - a * x).squaredNorm(), {}};
    for (int c = 0; c < 6; ++c) {
      candidate.k[c] = settings_.known[c].fixed.value_or(x[c] / scale[c]);
    }
    return candidate;
  }

  int bins() const { return bins_; }

 private:
  int bins_;
  const Record& turn_;
  const FitSettings& settings_;
  std::vector<int> axes_;
  std::vector<std::array<force::Sensitivity::Vector, force::kFittedColumns>> table_;
};

/// Phases at which the rest is least, best first; of negative Ktc only if there is no other.
std::vector<Candidate> best_phases(const cutter::Cutter& cutter, const Record& turn,
                                   const FitSettings& settings) {
  constexpr std::size_t kMost = 3;
  const PhaseScan scan(cutter, turn, settings);
  std::vector<Candidate> all;
  for (int shift = 0; shift < scan.bins(); ++shift) all.push_back(scan.at(shift));
  const bool equal = cutter::has_equal_flutes(cutter);
  const int period = equal ? scan.bins() / cutter.flutes + 1 : scan.bins();
  std::vector<Candidate> least;
  for (int i = 0; i < period; ++i) {
    const Candidate& here = all[i];
    const Candidate& before = all[(i + scan.bins() - 1) % scan.bins()];
    const Candidate& after = all[(i + 1) % scan.bins()];
    if (here.squares <= before.squares && here.squares <= after.squares) least.push_back(here);
  }
  std::stable_sort(least.begin(), least.end(), [](const Candidate& a, const Candidate& b) {
    if ((a.k[0] > 0.0) != (b.k[0] > 0.0)) return a.k[0] > 0.0;
    return a.squares < b.squares;
  });
  if (least.size() > kMost) least.resize(kMost);
  return least;
}

/// Moves each start some steps towards its least; best first, of negative Ktc last.
std::vector<RecordState> followed(const cutter::Cutter& cutter, const Record& turn,
                                  FitSettings settings, std::vector<RecordState> starts,
                                  int steps) {
  settings.max_iterations = steps;
  const std::vector<Record> turns = {turn};
  std::vector<double> costs(starts.size());
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) {
    JointProblem problem(cutter, turns, settings, {starts[i]});
    costs[i] = problem.solve().cost;
    starts[i] = problem.states().front();
  });
  std::vector<std::size_t> order(starts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const bool a_cuts = starts[a].coefficients.k[0] > 0.0;
    const bool b_cuts = starts[b].coefficients.k[0] > 0.0;
    return a_cuts != b_cuts ? a_cuts : costs[a] < costs[b];
  });
  std::vector<RecordState> sorted;
  for (const std::size_t i : order) sorted.push_back(std::move(starts[i]));
  return sorted;
}

}  // namespace

double unexplained_part(const cutter::Cutter& cutter, const Record& turn) {
  double total = 0.0;
  for (const std::vector<double>& force : turn.trace.force) {
    double mean = 0.0;
    for (const double f : force) mean += f / static_cast<double>(force.size());
    for (const double f : force) total += (f - mean) * (f - mean);
  }
  const std::vector<Candidate> best = best_phases(cutter, turn, {});
  if (best.empty() || best.front().k[0] <= 0.0 || !(total > 0.0)) return 1.0;
  return std::min(1.0, best.front().squares / total);
}

void renumber_flutes(RecordState& state, int flutes, int steps) {
  const double angle = core::kTurn * steps / flutes;
  state.phase += angle;
  const double c = std::cos(angle), s = std::sin(angle);
  state.runout = {c * state.runout[0] + s * state.runout[1],
                  c * state.runout[1] - s * state.runout[0]};
}

RecordState find_start(const cutter::Cutter& cutter, const Record& record,
                       const FitSettings& settings, double known_phase, double spindle_speed) {
  Record turn = record;
  turn.trace = synchronous_average(record.trace, spindle_speed);
  turn.spindle_speed = spindle_speed;
  FitSettings one = settings;
  one.progress = nullptr;
  one.model = Model::constant;
  one.spindle_speed = Estimated::no;
  one.drift = Estimated::no;
  one.phase_drift_knots = 0;
  one.estimate_dynamometer = false;
  one.weigh_records_alike = false;
  one.below = 0.0;  // one revolution is too short to filter
  one.tolerance = 1e-6;
  if (settings.runout != Estimated::no) one.runout = Estimated::per_record;

  const double half_turn = core::kPi;  // from the middle of the record to that of the turn
  const double to_middle = 0.5 * static_cast<double>(record.trace.size() - 1) /
                           record.trace.sampling_rate * spindle_speed;
  std::vector<Candidate> phases;
  if (settings.phase == Estimated::no) {
    phases.push_back({known_phase + to_middle + half_turn, 0.0, {1000, 500, 300, 20, 20, 10}});
  } else {
    phases = best_phases(cutter, turn, one);
  }
  const double feed = record.feed_rate * core::kTurn / (spindle_speed * cutter.flutes);
  std::vector<RecordState> starts;
  for (const Candidate& phase : phases) {
    RecordState state;
    std::copy(phase.k.begin(), phase.k.end(), state.coefficients.k.begin());
    state.coefficients.reference_chip_thickness = settings.reference_chip_thickness;
    state.dynamometer = settings.dynamometer;
    state.phase = phase.phase;
    state.spindle_speed = spindle_speed;
    state.runout = {cutter.runout.offset * std::cos(cutter.runout.angle),
                    cutter.runout.offset * std::sin(cutter.runout.angle)};
    if (settings.runout == Estimated::no) {
      starts.push_back(state);
      continue;
    }
    for (int i = 0; i < 8; ++i) {
      const double offset = (i % 2 == 0 ? 0.05 : 0.4) * feed;
      state.runout = {offset * std::cos(core::kTurn * i / 8.0),
                      offset * std::sin(core::kTurn * i / 8.0)};
      starts.push_back(state);
    }
  }
  // All of them a few steps, the best of these to their least.
  constexpr std::size_t kFollowed = 4;
  for (const int steps : {4, 30}) {
    starts = followed(cutter, turn, one, std::move(starts), steps);
    if (starts.size() > kFollowed) starts.resize(kFollowed);
  }
  RecordState start = starts.front();
  start.phase -= half_turn;
  start.phase_drift.assign(settings.phase_drift_knots, 0.0);
  if (settings.phase != Estimated::no && cutter::has_equal_flutes(cutter)) {
    const double pitch = core::kTurn / cutter.flutes;
    renumber_flutes(start, cutter.flutes, -static_cast<int>(std::floor(start.phase / pitch)));
  }
  return start;
}

}  // namespace millstudy::identify
