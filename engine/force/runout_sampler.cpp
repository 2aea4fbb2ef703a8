// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "force/lanes_math.h"
#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// What the moments of a stretch are worth under the coefficients: the numbers that (F25) needs.
enum Worth {
  g0r,  ///< planar chip force, constant part, as a complex number
  g0i,
  g2r,  ///< planar chip force, second harmonic
  g2i,
  vc,  ///< axial chip force
  vs,
  tc,  ///< torque of the chip
  ts,
  er,  ///< planar edge force
  ei,
  ez,  ///< axial edge force
  et,  ///< torque of the edge
  kWorths
};
using Worths = std::array<double, kWorths>;

Worths worths(const EdgeMoments& m, const Coefficients& k) {
  Worths w;
  w[g0r] = k.Ktc * m.chip(0, 0);
  w[g0i] = k.Krc * m.chip(1, 0) + k.Kac * m.chip(2, 0);
  w[g2r] = k.Ktc * m.chip(0, 1) - (k.Krc * m.chip(1, 2) + k.Kac * m.chip(2, 2));
  w[g2i] = k.Ktc * m.chip(0, 2) + (k.Krc * m.chip(1, 1) + k.Kac * m.chip(2, 1));
  w[vc] = k.Krc * m.chip(1, 3) + k.Kac * m.chip(2, 3);
  w[vs] = k.Krc * m.chip(1, 4) + k.Kac * m.chip(2, 4);
  w[tc] = k.Ktc * m.chip(0, 3);
  w[ts] = k.Ktc * m.chip(0, 4);
  w[er] = k.Kte * m.edge(0, 0) - (k.Kre * m.edge(1, 1) + k.Kae * m.edge(2, 1));
  w[ei] = k.Kte * m.edge(0, 1) + (k.Kre * m.edge(1, 0) + k.Kae * m.edge(2, 0));
  w[ez] = k.Kre * m.edge(1, 2) + k.Kae * m.edge(2, 2);
  w[et] = k.Kte * m.edge(0, 2);
  return w;
}

/// Over sin(kappa), the chip of one reach is P cos(phi) + Q sin(phi), (F23).
struct Line {
  Lanes p;
  Lanes q;

  Lanes at(const SineAndCosine& phi) const { return p * phi.cosine + q * phi.sine; }
};

/// The cotangents between which a reach is the smallest and positive.
struct Range {
  Lanes low;
  Lanes high;
};

/// What of a range line m of all is the smallest and positive in.
Range range_of(const std::vector<Line>& lines, std::size_t m, Range range) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  // Where p t + q <= 0 has to hold.
  const auto keep_below = [&](const Lanes& p, const Lanes& q) {
    const Lanes root = -q / p;
    range.high = p > 0.0 ? smaller(range.high, root) : range.high;
    range.low = p < 0.0 ? larger(range.low, root) : range.low;
    range.high = (p == 0.0) & (q > 0.0) ? Lanes{} - kHuge : range.high;
  };
  for (std::size_t other = 0; other < lines.size(); ++other) {
    if (other != m) keep_below(lines[m].p - lines[other].p, lines[m].q - lines[other].q);
  }
  keep_below(-lines[m].p, -lines[m].q);
  return range;
}

/// (F25) of one coefficient set along one piece.
class Stretch {
 public:
  Stretch(const MomentSeries& series, const Coefficients& k)
      : variable_(series.variable), whole_(worths(series.whole, k)) {
    terms_.reserve(series.terms.size());
    for (const EdgeMoments& term : series.terms) terms_.push_back(worths(term, k));
  }

  struct Values {
    std::array<Lanes, kWorths> of;
  };

  /// The worths of the stretch up to a part of the piece, 0 .. 1.
  [[gnu::always_inline]] Values up_to(const Lanes& part) const {
    Values values;
    const auto within = (part > 0.0) & (part < 1.0);
    if (any(within)) {
      const Lanes t = variable_.at(part);
      const Lanes twice = 2.0 * t;
      std::array<Lanes, kWorths> one{}, two{};
      for (std::size_t m = terms_.size() - 1; m > 0; --m) {
        const Worths& term = terms_[m];
#pragma GCC unroll 12
        for (int k = 0; k < kWorths; ++k) {
          const Lanes next = term[k] + (twice * one[k] - two[k]);
          two[k] = one[k];
          one[k] = next;
        }
      }
#pragma GCC unroll 12
      for (int k = 0; k < kWorths; ++k) {
        const Lanes ends = part >= 1.0 ? Lanes{} + whole_[k] : Lanes{};
        values.of[k] = within ? terms_[0][k] + (t * one[k] - two[k]) : ends;
      }
    } else {
#pragma GCC unroll 12
      for (int k = 0; k < kWorths; ++k) values.of[k] = part >= 1.0 ? Lanes{} + whole_[k] : Lanes{};
    }
    return values;
  }

 private:
  SeriesVariable variable_;
  Worths whole_;
  std::vector<Worths> terms_;
};

struct Force {
  Lanes x{}, y{}, z{}, torque{};

  /// Adds another where the mask says so.
  template <class Mask>
  [[gnu::always_inline]] void add(const Mask& mask, double sign, const Force& other) {
    x += mask ? sign * other.x : Lanes{};
    y += mask ? sign * other.y : Lanes{};
    z += mask ? sign * other.z : Lanes{};
    torque += mask ? sign * other.torque : Lanes{};
  }
};

/// (F25): the force of a stretch whose upper point stands at b, under one line.
[[gnu::always_inline]] inline Force force_of_stretch(const Stretch::Values& w,
                                                     const SineAndCosine& b, const Line& line) {
  const Lanes c = b.cosine, s = b.sine;
  const Lanes c2 = c * c - s * s, s2 = 2.0 * s * c;
  const Lanes hr = c2 * w.of[g2r] + s2 * w.of[g2i];
  const Lanes hi = c2 * w.of[g2i] - s2 * w.of[g2r];
  const auto along = [&](int cosine, int sine) {
    return line.p * (c * w.of[cosine] + s * w.of[sine]) +
           line.q * (s * w.of[cosine] - c * w.of[sine]);
  };
  return {-0.5 * (line.p * (w.of[g0r] + hr) + line.q * (w.of[g0i] - hi)) -
              (c * w.of[er] + s * w.of[ei]),
          -0.5 * (line.p * (w.of[g0i] + hi) + line.q * (hr - w.of[g0r])) -
              (c * w.of[ei] - s * w.of[er]),
          along(vc, vs) + w.of[ez], along(tc, ts) + w.of[et]};
}

/// A point of the piece where a stretch begins or ends.
struct End {
  Lanes part;         ///< of the piece below it, 0 .. 1
  SineAndCosine phi;  ///< of its immersion angle
  Stretch::Values worth;
};

/// The teeth before one tooth.
struct Before {
  double feed;             ///< since they passed [mm]
  double one_less_cosine;  ///< of how far ahead of it they stand
  double sine;
};

}  // namespace

RunoutEdge::RunoutEdge(const CuttingEdges& edges, Rows rows, const EdgePiece& piece)
    : rows_(rows),
      hand_(hand(edges.flutes()[0].helix_tangent)),
      shift_(edges.flutes()[0].helix_tangent * edges.envelope().lag(piece.bottom)),
      lag_(lag_over(edges.flutes()[0].helix_tangent,
                    edges.envelope().lag(piece.top) - edges.envelope().lag(piece.bottom))),
      per_lag_(1.0 / std::max(lag_, 1e-300)),
      series_(moment_series(edges, rows, 0, piece)) {}

/// One pass of one tooth over one piece: eight spindle angles at a time.
struct RunoutEdge::Sweep {
  const RunoutEdge& edge;
  const Stretch& stretch;
  const Arc& arc;

  Lanes angle_of(const Lanes& part, const Lanes& lower) const {
    return lower - edge.hand_ * edge.lag_ * part;
  }

  /// Which part of the piece is below the point at an immersion angle, if its lower end is at
  /// `lower`.
  [[gnu::always_inline]] Lanes part_below(const Lanes& phi, const Lanes& lower) const {
    const Lanes past = edge.hand_ * (lower - phi);
    const Lanes size = past < 0.0 ? -past : past;
    const Lanes part = (size < kAngleSnap ? Lanes{} : past) * edge.per_lag_;
    return part > 0.0 ? (part < 1.0 ? part : Lanes{} + 1.0) : Lanes{};
  }

  [[gnu::always_inline]] End end_at(const Lanes& part, const Lanes& lower) const {
    return {part, sine_and_cosine(angle_of(part, lower)), stretch.up_to(part)};
  }

  /// The force under whichever line is the smallest, where it is positive. Mostly one line is it
  /// all over the piece; only where the edge crosses from one to another are the crossings
  /// computed.
  [[gnu::always_inline]] Force force(const std::vector<Line>& lines, const Lanes& lower) const {
    const bool right = edge.hand_ > 0.0;
    const Lanes entry = part_below(arc.entry_angle + Lanes{}, lower);
    const Lanes exit = part_below(arc.exit_angle + Lanes{}, lower);
    const End top = end_at(right ? entry : exit, lower);
    End bottom = {right ? exit : entry, {}, {}};
    bottom.phi = sine_and_cosine(angle_of(bottom.part, lower));
    const bool above_the_lower_end = any(bottom.part > 0.0);
    if (above_the_lower_end) bottom.worth = stretch.up_to(bottom.part);
    const auto engaged = bottom.part < top.part;
    Line line = lines[0];
    Lanes at_top = line.at(top.phi), at_bottom = line.at(bottom.phi);
    Lanes which_top{}, which_bottom{};
    for (std::size_t m = 1; m < lines.size(); ++m) {
      const Lanes here = lines[m].at(top.phi), there = lines[m].at(bottom.phi);
      const auto less = here < at_top;
      line = {less ? lines[m].p : line.p, less ? lines[m].q : line.q};
      which_top = less ? Lanes{} + static_cast<double>(m) : which_top;
      at_top = less ? here : at_top;
      which_bottom = there < at_bottom ? Lanes{} + static_cast<double>(m) : which_bottom;
      at_bottom = there < at_bottom ? there : at_bottom;
    }
    const auto one = engaged & (which_top == which_bottom) & (at_top >= 0.0) & (at_bottom >= 0.0);
    Force sum;
    sum.add(one, 1.0, force_of_stretch(top.worth, top.phi, line));
    if (above_the_lower_end) {
      sum.add(one, -1.0, force_of_stretch(bottom.worth, bottom.phi, line));
    }
    const auto crossing = engaged & ~one;
    if (any(crossing)) add_crossing(sum, lines, lower, top, bottom, crossing);
    return sum;
  }

  template <class Mask>
  [[gnu::noinline]] void add_crossing(Force& sum, const std::vector<Line>& lines,
                                      const Lanes& lower, const End& top, const End& bottom,
                                      const Mask& crossing) const {
    // At 0 and pi the sine may come out below zero by rounding, which would turn the sign.
    const Lanes smallest = Lanes{} + 1e-300;
    const Lanes t_top = top.phi.cosine / larger(top.phi.sine, smallest);
    const Lanes t_bottom = bottom.phi.cosine / larger(bottom.phi.sine, smallest);
    const Range all = {smaller(t_top, t_bottom), larger(t_top, t_bottom)};
    const bool right = edge.hand_ > 0.0;
    for (std::size_t m = 0; m < lines.size(); ++m) {
      const Range range = range_of(lines, m, all);
      const auto within = crossing & (range.low < range.high);
      if (!any(within)) continue;
      const auto add = [&](const End& end, const Lanes& bound, const Lanes& end_bound,
                           double sign) {
        const auto inside = within & (bound != end_bound);
        if (any(inside)) {
          const Lanes part = part_below(arc_cotangent(bound), lower);
          const End crossed = end_at(inside ? part : end.part, lower);
          sum.add(within, sign, force_of_stretch(crossed.worth, crossed.phi, lines[m]));
        } else if (any(end.part > 0.0)) {
          sum.add(within, sign, force_of_stretch(end.worth, end.phi, lines[m]));
        }
      };
      // Up the edge of a right-hand cutter immersion angles fall, and their cotangents grow.
      add(top, right ? range.high : range.low, right ? all.high : all.low, 1.0);
      add(bottom, right ? range.low : range.high, right ? all.low : all.high, -1.0);
    }
  }
};

void RunoutEdge::add_to(SamplingRun& run, const CuttingEdges& edges, int flute,
                        const Coefficients& k, const Feed& feed, const Arc& arc) const {
  const Stretch stretch(series_, k);
  const Sweep sweep{*this, stretch, arc};
  const auto count = static_cast<int>(edges.flutes().size());
  const cutter::Runout& runout = edges.cutter().runout;
  const Angle direction(std::remainder(feed.direction, 2.0 * core::kPi));
  const Angle zero(direction.value + runout.angle);
  std::vector<Reach> reaches(count);
  ChipLaw(edges).find(flute, 0.0, 0.0, reaches);
  std::vector<Before> before(count);
  for (int m = 0; m < count; ++m) {
    const double ahead = reaches[m].ratio * 2.0 * core::kPi / count;
    before[m] = {feed.per_tooth * reaches[m].ratio, 1.0 - std::cos(ahead), std::sin(ahead)};
  }
  before.back().one_less_cosine = before.back().sine = 0.0;  // itself, a turn ago
  std::vector<Line> lines(count);
  const Closed closed = hand_ > 0.0 ? Closed::above : Closed::below;
  const double from = arc.entry_angle + shift_ - (hand_ > 0.0 ? 0.0 : lag_);
  const double to = arc.exit_angle + shift_ + (hand_ > 0.0 ? lag_ : 0.0);
  const AngleTables& tables = run.tables();
  run.begin_tooth(Angle(edges.flutes()[flute].position));
  run.for_each_pass(from, to, [&](const Pass& pass) {
    const double start = pass.offset - shift_;
    run.accumulate(run.between(pass, from, to, closed), [&](int n, Lanes& x, Lanes& y, Lanes& z,
                                                            Lanes& torque) {
      const Lanes c1 = load(&tables.cos1[n]), s1 = load(&tables.sin1[n]);
      const Lanes cos_a = runout.offset * (c1 * zero.cosine - s1 * zero.sine);
      const Lanes sin_a = runout.offset * (s1 * zero.cosine + c1 * zero.sine);
      for (int m = 0; m < count; ++m) {
        lines[m] = {cos_a * before[m].one_less_cosine - sin_a * before[m].sine,
                    before[m].feed + sin_a * before[m].one_less_cosine + cos_a * before[m].sine};
      }
      Force force = sweep.force(lines, start + tables.step * (static_cast<double>(n) + kLaneIndex));
      if (rows_ == Rows::moments) {
        const Lanes turned = -force.y;
        force.y = force.x;
        force.x = turned;
      }
      x = force.x * direction.cosine - force.y * direction.sine;
      y = force.x * direction.sine + force.y * direction.cosine;
      z = force.z;
      torque = force.torque;
    });
  });
}

}  // namespace millstudy::force
