// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "force/edge_moments.h"
#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

std::vector<double> combined(const PreparedRows& series, const Combination& with, double factor) {
  std::vector<double> terms(series.padded());
  series.combine(with, factor, terms.data());
  terms.resize(kRows * series.rows());
  return terms;
}

}  // namespace

SeriesEdge::SeriesEdge(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece)
    : rows_(rows),
      hand_(hand(edges.flutes()[flute].helix_tangent)),
      shift_(edges.flutes()[flute].helix_tangent * edges.envelope().lag(piece.bottom)),
      lag_(lag_over(edges.flutes()[flute].helix_tangent,
                    edges.envelope().lag(piece.top) - edges.envelope().lag(piece.bottom))),
      series_(moment_series(edges, rows, flute, piece)),
      whole_([&](double cosine, double sine) {
        const double behind = edges.flutes()[flute].helix_tangent * edges.envelope().lag(piece.top);
        const double c = std::cos(behind), s = std::sin(behind);
        return series_.whole.basis(rows, cosine * c + sine * s, sine * c - cosine * s);
      }) {}

PreparedRows SeriesEdge::series_at(double limit) const {
  PreparedRows series(series_.terms.size());
  const double c = std::cos(limit), s = std::sin(limit);
  for (std::size_t m = 0; m < series_.terms.size(); ++m) {
    series.add(m, series_.terms[m].basis(rows_, c, s), 1.0);
  }
  return series;
}

SeriesEdge::AtArc SeriesEdge::at(const Arc& arc) const {
  return {arc, series_at(arc.entry_angle), series_at(arc.exit_angle)};
}

/// (F15): each limit of the engagement travels up the edge while the tip goes on by the lag.
void SeriesEdge::add_to(SamplingRun& run, const Combination& with, const AtArc& engaged) const {
  const Harmonics whole = whole_.combine(with);
  const std::vector<double> entry = combined(engaged.entry, with, hand_);
  const std::vector<double> exit = combined(engaged.exit, with, -hand_);
  const Closed closed = hand_ > 0.0 ? Closed::above : Closed::below;
  const double past = hand_ > 0.0 ? lag_ : 0.0;     // the limit leaves the edge after the tip
  const double before = hand_ > 0.0 ? 0.0 : -lag_;  // the limit is on the edge before the tip
  const double entry_angle = engaged.arc.entry_angle + shift_;
  const double exit_angle = engaged.arc.exit_angle + shift_;
  run.for_each_pass(entry_angle + before, exit_angle + past, [&](const Pass& pass) {
    const auto around = [&](double limit) {
      return run.between(pass, limit + before, limit + past, closed);
    };
    run.add_series(pass, around(entry_angle), entry, series_.kind, hand_, entry_angle, lag_,
                   series_.variable);
    run.add_series(pass, around(exit_angle), exit, series_.kind, hand_, exit_angle, lag_,
                   series_.variable);
    const double from = hand_ > 0.0 ? entry_angle + lag_ : entry_angle - lag_;
    const double to = hand_ > 0.0 ? exit_angle + lag_ : exit_angle - lag_;
    run.add(pass, run.between(pass, from, to, closed), whole);
  });
}

}  // namespace millstudy::force
