// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

using Series = std::vector<Basis<double>>;

/// Enough for a whole ball at 80 deg of helix; the series is cut where its terms are rounding.
constexpr int kNodes = 96;
constexpr double kNegligible = 1e-17;

void add_scaled(Basis<double>& sum, const Basis<double>& term, double factor) {
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      sum.chip[row][column] += factor * term.chip[row][column];
      sum.edge[row][column] += factor * term.edge[row][column];
    }
  }
}

double largest_entry(const Basis<double>& basis) {
  double largest = 0.0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      largest =
          std::max({largest, std::abs(basis.chip[row][column]), std::abs(basis.edge[row][column])});
    }
  }
  return largest;
}

/// (F14): Chebyshev coefficients, in 2 sqrt(l / lag) - 1, of the edge from the tip up to the lag
/// l, whose point at l stands at the angle `limit`.
Series series_at(const cutter::Cutter& cutter, double limit, double top) {
  std::vector<Basis<double>> values(kNodes);
  for (int i = 0; i < kNodes; ++i) {
    const double s = 0.5 + 0.5 * std::cos(core::kPi * (i + 0.5) / kNodes);
    const double z = top * s * s;
    add_edge(values[i], cutter, limit + cutter::lag_rate(cutter) * z, 0.0, z);
  }
  Series series(kNodes);
  double largest = 0.0;
  for (int m = 0; m < kNodes; ++m) {
    for (int i = 0; i < kNodes; ++i) {
      const double angle = core::kPi * m * (i + 0.5) / kNodes;
      add_scaled(series[m], values[i], (m == 0 ? 1.0 : 2.0) / kNodes * std::cos(angle));
    }
    largest = std::max(largest, largest_entry(series[m]));
  }
  while (series.size() > 1 && largest_entry(series.back()) < kNegligible * largest) {
    series.pop_back();
  }
  return series;
}

std::vector<Harmonics::Row> combine(const Series& series, const Combination& with, double sign) {
  std::vector<Harmonics::Row> rows;
  rows.reserve(series.size());
  for (const Basis<double>& term : series) {
    Harmonics::Row row = with(term);
    for (double& value : row) value *= sign;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

CurvedEdge::CurvedEdge(const cutter::Cutter& cutter, const Engagement& engagement, double top)
    : entry_angle_(engagement.entry_angle),
      exit_angle_(engagement.exit_angle),
      hand_(hand(cutter)),
      lag_(lag_over(cutter, top)),
      whole_([&](double tip_angle) {
        Basis<double> basis;
        add_edge(basis, cutter, tip_angle, 0.0, top);
        return basis;
      }),
      at_entry_(series_at(cutter, engagement.entry_angle, top)),
      at_exit_(series_at(cutter, engagement.exit_angle, top)) {}

/// (F15): each limit of the engagement travels up the edge while the tip goes on by the lag.
void CurvedEdge::add_to(SamplingRun& run, const Combination& with) const {
  const Harmonics whole = whole_.combine(with);
  const std::vector<Harmonics::Row> entry = combine(at_entry_, with, hand_);
  const std::vector<Harmonics::Row> exit = combine(at_exit_, with, -hand_);
  const Closed closed = hand_ > 0.0 ? Closed::above : Closed::below;
  const double past = hand_ > 0.0 ? lag_ : 0.0;     // the limit leaves the edge after the tip
  const double before = hand_ > 0.0 ? 0.0 : -lag_;  // the limit is on the edge before the tip
  run.for_each_pass(entry_angle_ + before, exit_angle_ + past, [&](const Pass& pass) {
    const auto around = [&](double limit) {
      return run.between(pass, limit + before, limit + past, closed);
    };
    run.add_chebyshev(pass, around(entry_angle_), entry, hand_, entry_angle_, lag_);
    run.add_chebyshev(pass, around(exit_angle_), exit, hand_, exit_angle_, lag_);
    const double from = hand_ > 0.0 ? entry_angle_ + lag_ : entry_angle_ - lag_;
    const double to = hand_ > 0.0 ? exit_angle_ + lag_ : exit_angle_ - lag_;
    run.add(pass, run.between(pass, from, to, closed), whole);
  });
}

}  // namespace millstudy::force
