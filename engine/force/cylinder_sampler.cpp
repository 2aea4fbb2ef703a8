// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cutter/envelope.h"
#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

using Row = Harmonics::Row;

/// Ramps shorter than this are Taylor series: 12 terms leave 1e-17 of the full force there, and
/// beyond it the closed form loses no more than a factor of 8 to cancellation.
constexpr double kShortRamp = 0.125;

/// Force of unit height of edge, as harmonics of the immersion angle of the point itself.
HarmonicBasis density_of(const cutter::Cutter& cutter) {
  const double length = cutter::edge_length_rate(cutter);
  const double r = cutter::radius(cutter);
  return HarmonicBasis([&](double phi) {
    Basis<double> basis;
    add_slice(basis, edge_axes(std::sin(phi), std::cos(phi), 1.0, 0.0, r), std::sin(phi), length);
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

CylinderEdge::CylinderEdge(const cutter::Cutter& cutter, const Engagement& engagement, double z1,
                           double z2)
    : entry_(engagement.entry_angle),
      exit_(engagement.exit_angle),
      high_shift_(-std::min(cutter::lag_rate(cutter) * z1, cutter::lag_rate(cutter) * z2)),
      low_shift_(-std::max(cutter::lag_rate(cutter) * z1, cutter::lag_rate(cutter) * z2)),
      lag_(lag_over(cutter, z2 - z1)),
      ramp_(std::min(lag_, exit_.value - entry_.value)),
      per_lag_((z2 - z1) / lag_),
      closed_(hand(cutter) > 0.0 ? Closed::above : Closed::below),
      density_(density_of(cutter)),
      whole_([&](double tip_angle) {
        Basis<double> basis;
        add_edge(basis, cutter, tip_angle, z1, z2);
        return basis;
      }) {}

/// (F13): the three stretches of a pass, by the immersion angles high and low of the edge's ends.
void CylinderEdge::add_to(SamplingRun& run) const {
  const double width = exit_.value - entry_.value;
  const Harmonics density = density_.combine(run.with());
  const Harmonics middle = lag_ <= width
                               ? whole_.combine(run.with())
                               : between_limits(density, entry_.value, exit_.value, per_lag_);
  const double from = entry_.value - high_shift_.value + ramp_;
  const double to = exit_.value - low_shift_.value - ramp_;
  run.for_each_pass(from, to, [&](const Pass& pass) {
    run.add(pass, run.between(pass, from, to, closed_), middle);
  });
  ramp_ < kShortRamp ? add_short_ramps(run, density) : add_long_ramps(run, density);
}

void CylinderEdge::add_short_ramps(SamplingRun& run, const Harmonics& density) const {
  const double entering = entry_.value - high_shift_.value;  // tip angle of the first contact
  const double leaving = exit_.value - low_shift_.value;     // and of the last
  const SamplingRun::Taylor up = taylor_of(density, entry_, per_lag_, 1.0);
  const SamplingRun::Taylor down = taylor_of(density, exit_, per_lag_, -1.0);
  run.for_each_pass(entering, leaving, [&](const Pass& pass) {
    run.add_taylor(pass, run.between(pass, entering, entering + ramp_, closed_), up, 1.0, entering);
    run.add_taylor(pass, run.between(pass, leaving - ramp_, leaving, closed_), down, -1.0, leaving);
  });
}

void CylinderEdge::add_long_ramps(SamplingRun& run, const Harmonics& density) const {
  const double entering = entry_.value - high_shift_.value;
  const double leaving = exit_.value - low_shift_.value;
  const Harmonics integral = integral_of(density, per_lag_);
  const Row slope = scaled(density.constant, per_lag_);
  const Row opposite = scaled(slope, -1.0);
  Harmonics up = shifted(integral, high_shift_);
  up.constant = scaled(value_at(integral, entry_), -1.0);
  Harmonics down = negative(shifted(integral, low_shift_));
  down.constant = value_at(integral, exit_);
  run.for_each_pass(entering, leaving, [&](const Pass& pass) {
    run.add(pass, run.between(pass, entering, entering + ramp_, closed_), up, slope, entering);
    run.add(pass, run.between(pass, leaving - ramp_, leaving, closed_), down, opposite, leaving);
  });
}

}  // namespace millstudy::force
