// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// Terms below this part of the largest are rounding.
constexpr double kNegligible = 1e-16;

/// Chebyshev coefficients of `nodes` values of U (F14), in 2 sqrt(l / lag) - 1.
PreparedRows transform(const std::vector<Basis<double>>& values) {
  const int nodes = static_cast<int>(values.size());
  std::vector<double> cosines;  // of pi i / (2 nodes), a whole turn
  for (int i = 0; i < 4 * nodes; ++i) cosines.push_back(std::cos(0.5 * core::kPi * i / nodes));
  PreparedRows series(nodes);
  for (int m = 0; m < nodes; ++m) {
    for (int i = 0; i < nodes; ++i) {
      const double factor = (m == 0 ? 1.0 : 2.0) / nodes;
      series.add(m, values[i], factor * cosines[m * (2 * i + 1) % (4 * nodes)]);
    }
  }
  return series;
}

/// (F14): the edge from the tip up to the lag l, whose point at l stands at the angle `limit`. 32
/// terms are enough for the usual helix; a whole ball at 80 deg takes 96.
PreparedRows series_at(const cutter::Cutter& cutter, double limit, double top) {
  for (const int nodes : {32, 64, 96}) {
    std::vector<Basis<double>> values(nodes);
    for (int i = 0; i < nodes; ++i) {
      const double s = 0.5 + 0.5 * std::cos(core::kPi * (i + 0.5) / nodes);
      const double z = top * s * s;
      add_edge(values[i], cutter, limit + cutter::lag_rate(cutter) * z, 0.0, z);
    }
    PreparedRows series = transform(values);
    double largest = 0.0;
    for (int m = 0; m < nodes; ++m) largest = std::max(largest, series.largest(m));
    int terms = nodes;
    while (terms > 1 && series.largest(terms - 1) < kNegligible * largest) --terms;
    if (terms > nodes - 2 && nodes < 96) continue;  // not resolved: the tail is no rounding yet
    series.keep(terms);
    return series;
  }
  return PreparedRows{};
}

std::vector<double> combined(const PreparedRows& series, const Combination& with, double factor) {
  std::vector<double> terms(series.padded());
  series.combine(with, factor, terms.data());
  terms.resize(kRows * series.rows());
  return terms;
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
void CurvedEdge::add_to(SamplingRun& run) const {
  const Combination& with = run.with();
  const Harmonics whole = whole_.combine(with);
  const std::vector<double> entry = combined(at_entry_, with, hand_);
  const std::vector<double> exit = combined(at_exit_, with, -hand_);
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
