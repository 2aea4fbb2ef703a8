// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "force/gathered_nodes.h"
#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

constexpr double kNegligible = 1e-15;
constexpr double kUnresolved = 1e-12;

/// The lags of a piece, from its lower end.
struct PieceLag {
  double lower;    ///< over the tangent of the helix, at the lower end
  double range;    ///< of the piece, likewise
  double tangent;  ///< of the helix angle
  double all() const { return lag_over(tangent, range); }
};

/// One tooth over one piece with its lower end at an angle, origin + d, (F26): chip columns of unit
/// feed. The two are kept apart so that a limit at the origin is d away to the last digit.
Basis<double> at_angle(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece,
                       const PieceLag& lag, const Arc& arc, double origin, double d) {
  const double lower = origin + d;
  const auto below = [&](double limit) {
    return std::clamp(hand(lag.tangent) * ((origin - limit) + d) / lag.all(), 0.0, 1.0);
  };
  const double a = below(arc.entry_angle), b = below(arc.exit_angle);
  const auto height = [&](double part) {
    return std::clamp(edges.envelope().height_at_lag(lag.lower + part * lag.range), piece.bottom,
                      piece.top);
  };
  const double z1 = height(std::min(a, b)), z2 = height(std::max(a, b));
  Basis<double> basis;
  if (z1 >= z2) return basis;
  const std::array<double, 3>& exponent = edges.variation().size_exponent;
  for_each_gathered_node(edges, piece, lag.tangent, z1, z2, [&](const EdgeNode& node) {
    const double phi = lower - lag.tangent * (node.lag - lag.lower);
    const double sin_phi = std::sin(phi), cos_phi = std::cos(phi);
    const double h = edges.pitch_ratio(flute, node.lag) * sin_phi * node.sin_kappa;
    if (h <= 0.0) return;
    Matrix43<double> axes =
        edge_axes(sin_phi, cos_phi, node.sin_kappa, node.cos_kappa, node.radius);
    if (rows == Rows::moments) axes = moment_axes(axes, sin_phi, cos_phi, node.radius, node.z);
    std::array<double, 6> factors = edges.factors(flute, node);
    for (int q = 0; q < kColumns; ++q) {
      if (exponent[q] != 0.0) factors[q] *= std::pow(h, -exponent[q]);
    }
    add_slice(basis, axes, {h * node.width, node.length, 0.0}, factors);
  });
  return basis;
}

/// Chebyshev series of f(d), 0 <= d <= length, in 2 (d / length)^(1/4) - 1; empty where 96 terms
/// are not enough.
template <class Function>
PreparedRows series_of(double length, const Function& f) {
  for (const int nodes : ChebyshevNodes::kCounts) {
    const ChebyshevNodes& all = ChebyshevNodes::of(nodes);
    std::vector<Basis<double>> values(nodes);
    for (int i = 0; i < nodes; ++i) {
      const double u = 0.5 + 0.5 * all.node(i);
      values[i] = f(length * u * u * u * u);
    }
    PreparedRows series(nodes);
    for (int m = 0; m < nodes; ++m) {
      for (int i = 0; i < nodes; ++i) series.add(m, values[i], all.weight(m, i));
    }
    double largest = 0.0;
    for (int m = 0; m < nodes; ++m) largest = std::max(largest, series.largest(m));
    int terms = nodes;
    while (terms > 1 && series.largest(terms - 1) < kNegligible * largest) --terms;
    // A root leaves terms that fall slowly: where the last are below the accuracy, so are the rest.
    const double last = std::max(series.largest(nodes - 1), series.largest(nodes - 2));
    if (terms > nodes - 2 && (nodes < 96 || last > kUnresolved * largest)) continue;
    series.keep(terms);
    return series;
  }
  return PreparedRows{};
}

}  // namespace

SizeEffectEdge::SizeEffectEdge(const CuttingEdges& edges, Rows rows, int flute,
                               const EdgePiece& piece, const Arc& arc)
    : closed_(hand(edges.flutes()[flute].helix_tangent) > 0.0 ? Closed::above : Closed::below) {
  const double lower = edges.envelope().lag(piece.bottom);
  const PieceLag lag = {lower, edges.envelope().lag(piece.top) - lower,
                        edges.flutes()[flute].helix_tangent};
  const double shift = lag.tangent * lower;
  const double past = hand(lag.tangent) * lag.all();
  std::array<double, 4> corners = {arc.entry_angle, arc.exit_angle, arc.entry_angle + past,
                                   arc.exit_angle + past};
  std::sort(corners.begin(), corners.end());
  for (int i = 0; i < 3; ++i) {
    const double half = 0.5 * (corners[i + 1] - corners[i]);
    if (half < kAngleSnap) continue;
    for (const double sign : {1.0, -1.0}) {
      const double origin = sign > 0.0 ? corners[i] : corners[i + 1];
      stretches_.push_back({origin + shift, sign, half, series_of(half, [&](double d) {
                              return at_angle(edges, rows, flute, piece, lag, arc, origin,
                                              sign * d);
                            })});
      resolved_ &= stretches_.back().series.rows() > 0;
    }
  }
}

void SizeEffectEdge::add_to(SamplingRun& run, const Combination& with) const {
  for (const Stretch& stretch : stretches_) {
    std::vector<double> terms(stretch.series.padded());
    stretch.series.combine(with, 1.0, terms.data());
    terms.resize(kRows * stretch.series.rows());
    const double end = stretch.origin + stretch.sign * stretch.length;
    const double from = std::min(stretch.origin, end), to = std::max(stretch.origin, end);
    run.for_each_pass(from, to, [&](const Pass& pass) {
      run.add_quartic_chebyshev(pass, run.between(pass, from, to, closed_), terms, stretch.sign,
                                stretch.origin, stretch.length);
    });
  }
}

}  // namespace millstudy::force
