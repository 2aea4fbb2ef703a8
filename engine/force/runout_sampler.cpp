// SPDX-License-Identifier: MIT
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
};

/// The cotangents between which a reach is the smallest and positive.
struct Range {
  Lanes low;
  Lanes high;
};

Range range_of(const Line* lines, int count, int m) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  Range range = {Lanes{} - kHuge, Lanes{} + kHuge};
  // Where p t + q <= 0 has to hold.
  const auto keep_below = [&](const Lanes& p, const Lanes& q) {
    const Lanes root = -q / p;
    range.high = p > 0.0 ? smaller(range.high, root) : range.high;
    range.low = p < 0.0 ? larger(range.low, root) : range.low;
    range.high = p == 0.0 ? (q > 0.0 ? Lanes{} - kHuge : range.high) : range.high;
  };
  for (int other = 0; other < count; ++other) {
    if (other != m) keep_below(lines[m].p - lines[other].p, lines[m].q - lines[other].q);
  }
  keep_below(-lines[m].p, -lines[m].q);
  return range;
}

/// (F25) of one coefficient set along one piece.
class Stretch {
 public:
  Stretch(const MomentSeries& series, const Coefficients& k)
      : low_(std::sqrt(series.base)),
        base_(series.base),
        scale_(2.0 / (std::sqrt(series.base + 1.0) - low_)),
        whole_(worths(series.whole, k)) {
    terms_.reserve(series.terms.size());
    for (const EdgeMoments& term : series.terms) terms_.push_back(worths(term, k));
  }

  struct Values {
    std::array<Lanes, kWorths> of;
  };

  /// The worths of the stretch up to a part of the piece, 0 .. 1.
  [[gnu::always_inline]] Values up_to(const Lanes& part) const {
    Values values;
    if (any((part > 0.0) & (part < 1.0))) {
      const Lanes t = scale_ * (square_root(base_ + part) - low_) - 1.0;
      const Lanes twice = 2.0 * t;
      std::array<Lanes, kWorths> one{}, two{};
      for (std::size_t m = terms_.size() - 1; m > 0; --m) {
        for (int k = 0; k < kWorths; ++k) {
          const Lanes next = terms_[m][k] + (twice * one[k] - two[k]);
          two[k] = one[k];
          one[k] = next;
        }
      }
      for (int k = 0; k < kWorths; ++k) values.of[k] = terms_[0][k] + (t * one[k] - two[k]);
    }
    for (int k = 0; k < kWorths; ++k) {
      const Lanes ends = part >= 1.0 ? Lanes{} + whole_[k] : Lanes{};
      values.of[k] = (part > 0.0) & (part < 1.0) ? values.of[k] : ends;
    }
    return values;
  }

 private:
  double low_;
  double base_;
  double scale_;
  Worths whole_;
  std::vector<Worths> terms_;
};

struct Force {
  Lanes x, y, z, torque;
};

/// (F25): the force of a stretch whose upper point stands at b, under one line.
[[gnu::always_inline]] inline Force force_of_stretch(const Stretch::Values& w, const Lanes& b,
                                                     const Line& line) {
  const SineAndCosine at = sine_and_cosine(b);
  const Lanes c = at.cosine, s = at.sine;
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

/// The teeth before one tooth.
struct Before {
  double feed;    ///< since they passed [mm]
  double cosine;  ///< of how far ahead of it they stand
  double sine;
};

}  // namespace

RunoutEdge::RunoutEdge(const CuttingEdges& edges, Rows rows, const EdgePiece& piece)
    : rows_(rows),
      hand_(hand(edges.flutes()[0].helix_tangent)),
      shift_(edges.flutes()[0].helix_tangent * edges.envelope().lag(piece.bottom)),
      lag_(lag_over(edges.flutes()[0].helix_tangent,
                    edges.envelope().lag(piece.top) - edges.envelope().lag(piece.bottom))),
      series_(moment_series(edges, rows, 0, piece)) {}

void RunoutEdge::add_to(SamplingRun& run, const CuttingEdges& edges, int flute,
                        const Coefficients& k, const Feed& feed, const Arc& arc) const {
  const Stretch stretch(series_, k);
  const auto count = static_cast<int>(edges.flutes().size());
  const ChipLaw law(edges);
  const cutter::Runout& runout = edges.cutter().runout;
  const double offset = runout.offset;
  const Angle zero(std::remainder(feed.direction, 2.0 * core::kPi) + runout.angle);
  const Angle direction(std::remainder(feed.direction, 2.0 * core::kPi));
  std::vector<Line> lines(count);
  std::vector<Before> before(count);
  std::vector<Reach> reaches(count);
  const Closed closed = hand_ > 0.0 ? Closed::above : Closed::below;
  const double from = arc.entry_angle + shift_ - (hand_ > 0.0 ? 0.0 : lag_);
  const double to = arc.exit_angle + shift_ + (hand_ > 0.0 ? lag_ : 0.0);
  law.find(flute, 0.0, 0.0, reaches);
  for (int m = 0; m < count; ++m) {
    const double ahead = reaches[m].ratio * 2.0 * core::kPi / count;
    before[m] = {feed.per_tooth * reaches[m].ratio, std::cos(ahead), std::sin(ahead)};
  }
  before.back().cosine = 1.0, before.back().sine = 0.0;  // itself
  run.begin_tooth(Angle(edges.flutes()[flute].position));
  run.for_each_pass(from, to, [&](const Pass& pass) {
    const double start = pass.offset - shift_;
    run.accumulate(run.between(pass, from, to, closed), [&](int n, Lanes& x, Lanes& y, Lanes& z,
                                                            Lanes& torque) {
      const AngleTables& tables = run.tables();
      const Lanes c1 = load(&tables.cos1[n]), s1 = load(&tables.sin1[n]);
      const Lanes cos_a = c1 * zero.cosine - s1 * zero.sine;
      const Lanes sin_a = s1 * zero.cosine + c1 * zero.sine;
      for (int m = 0; m < count; ++m) {
        const double one_less = 1.0 - before[m].cosine;
        lines[m] = {offset * (cos_a * one_less - sin_a * before[m].sine),
                    before[m].feed + offset * (sin_a * one_less + cos_a * before[m].sine)};
      }
      const Lanes lower = start + tables.step * (static_cast<double>(n) + kLaneIndex);
      x = y = z = torque = Lanes{};
      for (int m = 0; m < count; ++m) {
        const Range range = range_of(lines.data(), count, m);
        if (!any(range.low < range.high)) continue;
        const Lanes phi1 = larger(arc.entry_angle + Lanes{}, arc_cotangent(range.high));
        const Lanes phi2 = smaller(arc.exit_angle + Lanes{}, arc_cotangent(range.low));
        // Where the chip begins and ends on the edge, in parts of the piece from its lower end.
        const auto part = [&](const Lanes& phi) {
          const Lanes past = hand_ * (lower - phi);
          const Lanes size = past < 0.0 ? -past : past;
          const Lanes inside = (size < kAngleSnap ? Lanes{} : past) / lag_;
          return inside > 0.0 ? (inside < 1.0 ? inside : Lanes{} + 1.0) : Lanes{};
        };
        const Lanes top = part(hand_ > 0.0 ? phi1 : phi2);
        const Lanes bottom = part(hand_ > 0.0 ? phi2 : phi1);
        const auto inside = (range.low < range.high) & (bottom < top);
        if (!any(inside)) continue;
        const auto add = [&](const Lanes& at, double sign) {
          const Lanes b = lower - hand_ * lag_ * at;
          const Force force = force_of_stretch(stretch.up_to(at), b, lines[m]);
          x += inside ? sign * force.x : Lanes{};
          y += inside ? sign * force.y : Lanes{};
          z += inside ? sign * force.z : Lanes{};
          torque += inside ? sign * force.torque : Lanes{};
        };
        add(top, 1.0);
        if (any(inside & (bottom > 0.0))) add(bottom, -1.0);
      }
      if (rows_ == Rows::moments) {
        const Lanes turned = -y;
        y = x;
        x = turned;
      }
      const Lanes turned = x * direction.cosine - y * direction.sine;
      y = x * direction.sine + y * direction.cosine;
      x = turned;
    });
  });
}

}  // namespace millstudy::force
