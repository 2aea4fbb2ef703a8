// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// Terms below this part of the largest are rounding.
constexpr double kNegligible = 1e-16;
/// All numbers of a harmonic basis: harmonics, rows, columns.
constexpr int kNumbers = kHarmonics * kRows * kLoads;
using Numbers = std::array<double, kNumbers>;

/// Where an arc's root sqrt(z - z_lowest) is nearly singular in a piece, the series have to go with
/// it: its place below the lower end, in units of the piece. 0 where it is far.
double base_of(const EdgePiece& piece) {
  if (!piece.segment.is_arc) return 0.0;
  constexpr double kFar = 3.0;
  const double lowest = piece.segment.centre_height - piece.segment.corner_radius;
  const double base = (piece.bottom - lowest) / (piece.top - piece.bottom);
  // An arc that begins at its lowest point may miss it by rounding.
  return piece.bottom == 0.0 && base < 1e-9 ? 0.0 : base > kFar ? 0.0 : std::max(0.0, base);
}

/// Integral from the lower end of the piece, for five angles of that end.
class Growing {
 public:
  Growing(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece)
      : edges_(edges),
        rows_(rows),
        flute_(flute),
        piece_(piece),
        tangent_(edges.flutes()[flute].helix_tangent),
        lag_(edges.envelope().lag(piece.bottom)),
        height_(piece.bottom) {}

  void grow_to(double z) {
    const HarmonicAngles& angles = HarmonicAngles::get();
    if (z <= height_) return;
    edges_.for_each_node(piece_, tangent_, height_, z, [&](const EdgeNode& node) {
      const double behind = tangent_ * (node.lag - lag_);
      const double c = std::cos(behind), s = std::sin(behind);
      for (int i = 0; i < kHarmonics; ++i) {
        add_node(samples_[i], edges_, rows_, flute_, node,
                 angles.sine[i] * c - angles.cosine[i] * s,
                 angles.cosine[i] * c + angles.sine[i] * s);
      }
    });
    height_ = z;
  }

  /// Harmonics of the angle at which the upper point stands, (F14).
  Numbers harmonics_of_the_upper_point() const {
    const HarmonicAngles& angles = HarmonicAngles::get();
    const Angle behind(tangent_ * (edges_.envelope().lag(height_) - lag_));
    Numbers numbers{};
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kLoads; ++column) {
        std::array<double, kHarmonics> p{};
        for (int h = 0; h < kHarmonics; ++h) {
          for (int i = 0; i < kHarmonics; ++i) {
            p[h] += angles.weight[h][i] * entry(samples_[i], row, column);
          }
        }
        const double c = behind.cosine, s = behind.sine;
        const double c2 = c * c - s * s, s2 = 2.0 * s * c;
        const std::array<double, kHarmonics> q = {p[0], p[1] * c + p[2] * s, p[2] * c - p[1] * s,
                                                  p[3] * c2 + p[4] * s2, p[4] * c2 - p[3] * s2};
        for (int h = 0; h < kHarmonics; ++h) numbers[(h * kRows + row) * kLoads + column] = q[h];
      }
    }
    return numbers;
  }

  const Basis<double>& sample(int i) const { return samples_[i]; }

 private:
  const CuttingEdges& edges_;
  Rows rows_;
  int flute_;
  const EdgePiece& piece_;
  double tangent_;
  double lag_;
  double height_;
  std::array<Basis<double>, kHarmonics> samples_{};
};

/// Chebyshev coefficients of values at the nodes cos(pi (i + 1/2) / n).
std::vector<Numbers> chebyshev(const std::vector<Numbers>& values) {
  const int nodes = static_cast<int>(values.size());
  std::vector<double> cosines;  // of pi i / (2 nodes), a whole turn
  for (int i = 0; i < 4 * nodes; ++i) cosines.push_back(std::cos(0.5 * core::kPi * i / nodes));
  std::vector<Numbers> terms(nodes);
  for (int m = 0; m < nodes; ++m) {
    terms[m].fill(0.0);
    for (int i = 0; i < nodes; ++i) {
      const double factor = (m == 0 ? 1.0 : 2.0) / nodes * cosines[m * (2 * i + 1) % (4 * nodes)];
      for (int k = 0; k < kNumbers; ++k) terms[m][k] += factor * values[i][k];
    }
  }
  return terms;
}

double largest(const Numbers& numbers) {
  double most = 0.0;
  for (const double number : numbers) most = std::max(most, std::abs(number));
  return most;
}

/// (F14): 32 terms are enough for the usual helix; a whole ball at 80 deg takes 96.
std::vector<Numbers> series_of(const CuttingEdges& edges, Rows rows, int flute,
                               const EdgePiece& piece, double base) {
  const double lag1 = edges.envelope().lag(piece.bottom);
  const double lag2 = edges.envelope().lag(piece.top);
  const double low = std::sqrt(base);
  const double range = std::sqrt(base + 1.0) - low;
  for (const int nodes : {24, 48, 96}) {
    std::vector<Numbers> values(nodes);
    Growing edge(edges, rows, flute, piece);
    for (int i = nodes - 1; i >= 0; --i) {  // upward
      const double root = low + range * (0.5 + 0.5 * std::cos(core::kPi * (i + 0.5) / nodes));
      const double part = root * root - base;
      edge.grow_to(std::clamp(edges.envelope().height_at_lag(lag1 + part * (lag2 - lag1)),
                              piece.bottom, piece.top));
      values[i] = edge.harmonics_of_the_upper_point();
    }
    std::vector<Numbers> terms = chebyshev(values);
    double most = 0.0;
    for (const Numbers& term : terms) most = std::max(most, largest(term));
    int count = nodes;
    while (count > 1 && largest(terms[count - 1]) < kNegligible * most) --count;
    if (count > nodes - 2 && nodes < 96) continue;  // not resolved: the tail is no rounding yet
    terms.resize(count);
    return terms;
  }
  return {};
}

std::vector<double> combined(const PreparedRows& series, const Combination& with, double factor) {
  std::vector<double> terms(series.padded());
  series.combine(with, factor, terms.data());
  terms.resize(kRows * series.rows());
  return terms;
}

}  // namespace

SeriesEdge::SeriesEdge(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece)
    : hand_(hand(edges.flutes()[flute].helix_tangent)),
      shift_(edges.flutes()[flute].helix_tangent * edges.envelope().lag(piece.bottom)),
      lag_(lag_over(edges.flutes()[flute].helix_tangent,
                    edges.envelope().lag(piece.top) - edges.envelope().lag(piece.bottom))),
      base_(base_of(piece)),
      whole_([&](double cosine, double sine) {
        Basis<double> basis;
        add_piece(basis, edges, rows, flute, piece, std::atan2(sine, cosine), piece.bottom,
                  piece.top);
        return basis;
      }) {
  const std::vector<Numbers> terms = series_of(edges, rows, flute, piece, base_);
  for (int h = 0; h < kHarmonics; ++h) {
    series_[h] = PreparedRows(terms.size());
    for (std::size_t m = 0; m < terms.size(); ++m) {
      for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kLoads; ++column) {
          series_[h].at(m, row, column) = terms[m][(h * kRows + row) * kLoads + column];
        }
      }
    }
  }
}

PreparedRows SeriesEdge::series_at(double limit) const {
  PreparedRows sum = series_[0];
  sum.add(series_[1], std::cos(limit));
  sum.add(series_[2], std::sin(limit));
  sum.add(series_[3], std::cos(2.0 * limit));
  sum.add(series_[4], std::sin(2.0 * limit));
  return sum;
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
    run.add_chebyshev(pass, around(entry_angle), entry, hand_, entry_angle, lag_, base_);
    run.add_chebyshev(pass, around(exit_angle), exit, hand_, exit_angle, lag_, base_);
    const double from = hand_ > 0.0 ? entry_angle + lag_ : entry_angle - lag_;
    const double to = hand_ > 0.0 ? exit_angle + lag_ : exit_angle - lag_;
    run.add(pass, run.between(pass, from, to, closed), whole);
  });
}

}  // namespace millstudy::force
