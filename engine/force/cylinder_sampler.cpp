// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

using Row = Harmonics::Row;

/// Ramps shorter than this are Taylor series: 12 terms leave 1e-17 of the full force there, and
/// beyond it the closed form loses no more than a factor of 8 to cancellation.
constexpr double kShortRamp = 0.125;

/// Force of unit height of edge, as harmonics of the immersion angle of the point itself.
HarmonicBasis density_of(const CuttingEdges& edges, int flute, const EdgePiece& piece) {
  const double tangent = edges.flutes()[flute].helix_tangent;
  const EdgeNode unit = edges.node(piece, tangent, piece.bottom, 1.0);
  return HarmonicBasis([&](double cosine, double sine) {
    Basis<double> basis;
    add_node(basis, edges, Rows::forces, flute, unit, sine, cosine);
    return basis;
  });
}

/// Taylor terms of the integral of p from an angle on: term m is p^(m)(angle) / (m + 1)!, times
/// factor; signs alternate when the integral runs backward (direction -1).
SamplingRun::Taylor taylor_of(const Harmonics& p, const Angle& angle, double factor,
                              double direction) {
  const Harmonics q = shifted(p, angle);
  Row c1 = q.cos1, s1 = q.sin1, c2 = q.cos2, s2 = q.sin2;
  static constexpr std::array<double, SamplingRun::kTaylorTerms> kReciprocals = {
      1.0,     1.0 / 2, 1.0 / 3, 1.0 / 4,  1.0 / 5,  1.0 / 6,
      1.0 / 7, 1.0 / 8, 1.0 / 9, 1.0 / 10, 1.0 / 11, 1.0 / 12};
  SamplingRun::Taylor terms;
  for (int m = 0; m < SamplingRun::kTaylorTerms; ++m) {
    factor *= kReciprocals[m];
    for (int row = 0; row < kRows; ++row) {
      terms[m][row] = factor * (c1[row] + c2[row] + (m == 0 ? q.constant[row] : 0.0));
      // (c1, s1) -> derivative along the direction; the second harmonic turns twice as fast.
      c1[row] = std::exchange(s1[row], -direction * c1[row]) * direction;
      c2[row] = std::exchange(s2[row], -2.0 * direction * c2[row]) * 2.0 * direction;
    }
  }
  return terms;
}

/// Antiderivative of p without its linear part, times factor.
Harmonics integral_of(const Harmonics& p, double factor) {
  Harmonics integral;
  for (int row = 0; row < kRows; ++row) {
    integral.cos1[row] = -factor * p.sin1[row];
    integral.sin1[row] = factor * p.cos1[row];
    integral.cos2[row] = -0.5 * factor * p.sin2[row];
    integral.sin2[row] = 0.5 * factor * p.cos2[row];
  }
  return integral;
}

Row value_at(const Harmonics& p, const Angle& angle) {
  const Harmonics q = shifted(p, angle);
  Row value;
  for (int row = 0; row < kRows; ++row) value[row] = q.constant[row] + q.cos1[row] + q.cos2[row];
  return value;
}

/// Integral of p over an interval of angles, times factor: constant harmonics.
Harmonics between_limits(const Harmonics& p, double from, double to, double factor) {
  const double width = to - from;
  const double middle = 0.5 * (from + to);
  const Harmonics q = shifted(p, std::cos(middle), std::sin(middle));
  Harmonics sum;
  for (int row = 0; row < kRows; ++row) {
    sum.constant[row] =
        factor * width *
        (q.constant[row] + sinc(0.5 * width) * q.cos1[row] + sinc(width) * q.cos2[row]);
  }
  return sum;
}

Harmonics negative(Harmonics p) {
  for (Row* part : {&p.constant, &p.cos1, &p.sin1, &p.cos2, &p.sin2}) {
    for (double& value : *part) value = -value;
  }
  return p;
}

Row scaled(Row row, double factor) {
  for (double& value : row) value *= factor;
  return row;
}

}  // namespace

CylinderEdge::CylinderEdge(const CuttingEdges& edges, int flute, const EdgePiece& piece)
    : high_shift_(0.0),
      low_shift_(0.0),
      lag_(0.0),
      per_lag_(0.0),
      closed_(hand(edges.flutes()[flute].helix_tangent) > 0.0 ? Closed::above : Closed::below),
      density_(density_of(edges, flute, piece)),
      whole_([&](double cosine, double sine) {
        Basis<double> basis;
        add_edge(basis, edges, flute, std::atan2(sine, cosine), piece.bottom, piece.top);
        return basis;
      }) {
  const double tangent = edges.flutes()[flute].helix_tangent;
  const double lag1 = edges.envelope().lag(piece.bottom);
  const double lag2 = edges.envelope().lag(piece.top);
  high_shift_ = Angle(-std::min(tangent * lag1, tangent * lag2));
  low_shift_ = Angle(-std::max(tangent * lag1, tangent * lag2));
  lag_ = lag_over(tangent, lag2 - lag1);
  per_lag_ = (piece.top - piece.bottom) / lag_;
}

CylinderEdge::AtArc CylinderEdge::at(const Arc& arc) const {
  return {Angle(arc.entry_angle), Angle(arc.exit_angle),
          std::min(lag_, arc.exit_angle - arc.entry_angle)};
}

/// (F13): the three stretches of a pass, by the immersion angles high and low of the edge's ends.
void CylinderEdge::add_to(SamplingRun& run, const Combination& with, const AtArc& engaged) const {
  const double width = engaged.exit.value - engaged.entry.value;
  const Harmonics density = density_.combine(with);
  const Harmonics middle =
      lag_ <= width ? whole_.combine(with)
                    : between_limits(density, engaged.entry.value, engaged.exit.value, per_lag_);
  const double from = engaged.entry.value - high_shift_.value + engaged.ramp;
  const double to = engaged.exit.value - low_shift_.value - engaged.ramp;
  run.for_each_pass(from, to, [&](const Pass& pass) {
    run.add(pass, run.between(pass, from, to, closed_), middle);
  });
  engaged.ramp < kShortRamp ? add_short_ramps(run, density, engaged)
                            : add_long_ramps(run, density, engaged);
}

void CylinderEdge::add_short_ramps(SamplingRun& run, const Harmonics& density,
                                   const AtArc& engaged) const {
  const double ramp = engaged.ramp;
  const double entering = engaged.entry.value - high_shift_.value;  // tip angle of first contact
  const double leaving = engaged.exit.value - low_shift_.value;     // and of the last
  const SamplingRun::Taylor up = taylor_of(density, engaged.entry, per_lag_, 1.0);
  const SamplingRun::Taylor down = taylor_of(density, engaged.exit, per_lag_, -1.0);
  run.for_each_pass(entering, leaving, [&](const Pass& pass) {
    run.add_taylor(pass, run.between(pass, entering, entering + ramp, closed_), up, 1.0, entering);
    run.add_taylor(pass, run.between(pass, leaving - ramp, leaving, closed_), down, -1.0, leaving);
  });
}

void CylinderEdge::add_long_ramps(SamplingRun& run, const Harmonics& density,
                                  const AtArc& engaged) const {
  const double ramp = engaged.ramp;
  const double entering = engaged.entry.value - high_shift_.value;
  const double leaving = engaged.exit.value - low_shift_.value;
  const Harmonics integral = integral_of(density, per_lag_);
  const Row slope = scaled(density.constant, per_lag_);
  const Row opposite = scaled(slope, -1.0);
  Harmonics up = shifted(integral, high_shift_);
  up.constant = scaled(value_at(integral, engaged.entry), -1.0);
  Harmonics down = negative(shifted(integral, low_shift_));
  down.constant = value_at(integral, engaged.exit);
  run.for_each_pass(entering, leaving, [&](const Pass& pass) {
    run.add(pass, run.between(pass, entering, entering + ramp, closed_), up, slope, entering);
    run.add(pass, run.between(pass, leaving - ramp, leaving, closed_), down, opposite, leaving);
  });
}

}  // namespace millstudy::force
