// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <complex>
#include <span>
#include <vector>

#include "force/coefficients.h"
#include "force/edge_moments.h"
#include "force/engagement.h"
#include "force/harmonics.h"
#include "force/lanes_math.h"
#include "force/sampling_run.h"
#include "force/slice.h"

/// (F25): the force of a stretch of edge whose chip is linear in cos(phi) and sin(phi).
namespace millstudy::force {

[[gnu::always_inline]] inline SineAndCosine lanes_of(const Angle& angle) {
  return {Lanes{} + angle.sine, Lanes{} + angle.cosine};
}

/// Over sin(kappa), the chip of one reach is p cos(phi) + q sin(phi), (F23), [mm].
struct ChipLanes {
  Lanes p{};
  Lanes q{};

  Lanes at(const SineAndCosine& phi) const { return p * phi.cosine + q * phi.sine; }

  /// The angle, 0 .. pi, at which it is zero.
  Lanes zero() const {
    const auto turns = p < 0.0;
    return angle_of(turns ? q : -q, turns ? -p : p);
  }
};

/// A chip with the edge forces, which act where it is positive. All zero: no chip.
struct Line : ChipLanes {
  Lanes edge{};  ///< 1 or 0
};

/// The line of one reach over the tip angle tau of a tooth: P + i Q = turning exp(i tau) + i feed.
struct LineOfTip {
  std::complex<double> turning;  ///< [mm]
  double feed;                   ///< [mm]
};

template <class Mask>
[[gnu::always_inline]] inline ChipLanes select(const Mask& mask, const ChipLanes& a,
                                               const ChipLanes& b) {
  return {mask ? a.p : b.p, mask ? a.q : b.q};
}

/// Rows of the terms of a series: the force x, y, z, torque under one line that does not turn.
using SteadyTerms = std::vector<std::array<double, kRows>>;

struct ForceLanes {
  Lanes x{}, y{}, z{}, torque{};

  ForceLanes& operator+=(const ForceLanes& other) {
    x += other.x, y += other.y, z += other.z, torque += other.torque;
    return *this;
  }
  ForceLanes& operator-=(const ForceLanes& other) {
    x -= other.x, y -= other.y, z -= other.z, torque -= other.torque;
    return *this;
  }
};

/// Adds forces at a vector of angles of which the run goes on to the last.
inline void add_vector(SamplingRun& run, int n, int last, const ForceLanes& force) {
  run.accumulate({n, std::min(n + kLanes, last)},
                 [&](int, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
                   x = force.x, y = force.y, z = force.z, torque = force.torque;
                 });
}

template <class Mask>
[[gnu::always_inline]] inline ForceLanes select(const Mask& mask, const ForceLanes& a,
                                                const ForceLanes& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z, mask ? a.torque : b.torque};
}

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
  kChipWorths,
  er = kChipWorths,  ///< planar edge force
  ei,
  ez,  ///< axial edge force
  et,  ///< torque of the edge
  kWorths
};

/// Those of what does not depend on the immersion angle where it acts, in the order of the edge's.
/// @param moment  (column, i), as EdgeMoments::edge()
template <class Moment>
std::array<double, kWorths - kChipWorths> still_worths(const std::array<double, kColumns>& k,
                                                       const Moment& moment, double cosine,
                                                       double sine) {
  const double x = k[0] * moment(0, 0) - (k[1] * moment(1, 1) + k[2] * moment(2, 1));
  const double y = k[0] * moment(0, 1) + (k[1] * moment(1, 0) + k[2] * moment(2, 0));
  return {x * cosine - y * sine, x * sine + y * cosine, k[1] * moment(1, 2) + k[2] * moment(2, 2),
          k[0] * moment(0, 2)};
}

/// @param cosine, sine  of the angle from feed axes to those of the rows
inline std::array<double, kWorths> worths(const EdgeMoments& m, const Coefficients& k,
                                          double cosine, double sine) {
  std::array<double, kWorths> w;
  w[g0r] = k.Ktc * m.chip(0, 0);
  w[g0i] = k.Krc * m.chip(1, 0) + k.Kac * m.chip(2, 0);
  w[g2r] = k.Ktc * m.chip(0, 1) - (k.Krc * m.chip(1, 2) + k.Kac * m.chip(2, 2));
  w[g2i] = k.Ktc * m.chip(0, 2) + (k.Krc * m.chip(1, 1) + k.Kac * m.chip(2, 1));
  w[vc] = k.Krc * m.chip(1, 3) + k.Kac * m.chip(2, 3);
  w[vs] = k.Krc * m.chip(1, 4) + k.Kac * m.chip(2, 4);
  w[tc] = k.Ktc * m.chip(0, 3);
  w[ts] = k.Ktc * m.chip(0, 4);
  for (const int real : {g0r, g2r}) {
    const double turned = w[real] * cosine - w[real + 1] * sine;
    w[real + 1] = w[real] * sine + w[real + 1] * cosine;
    w[real] = turned;
  }
  const auto edge = still_worths(
      {k.Kte, k.Kre, k.Kae}, [&](int column, int i) { return m.edge(column, i); }, cosine, sine);
  std::copy(edge.begin(), edge.end(), w.begin() + er);
  return w;
}

/// (F25) of one coefficient set along one piece, in axes turned by an angle.
class RunoutStretch {
 public:
  template <class Value>
  using Worths = std::array<Value, kWorths>;

  /// @param cosine, sine  of the angle from feed axes to those of the rows
  RunoutStretch(const MomentSeries& series, const Coefficients& k, double cosine, double sine)
      : variable_(series.variable),
        kind_(series.kind),
        whole_(worths(series.whole, k, cosine, sine)) {
    terms_.reserve(series.terms.size());
    zero_terms_.reserve(series.terms.size());
    for (const EdgeMoments& term : series.terms) {
      const Worths<double> w = worths(term, k, cosine, sine);
      terms_.push_back(w);
      zero_terms_.push_back({0.5 * (w[g0i] - w[g2i]), -0.5 * (w[g0r] - w[g2r]), w[vs], w[ts], w[er],
                             w[ei], w[ez], w[et]});
    }
  }

  /// All of the piece, its upper end at an immersion angle.
  [[gnu::always_inline]] ForceLanes whole(const SineAndCosine& upper, const Line& line) const {
    return force(whole_, upper, line);
  }

  /// The piece from its lower end up to a part of it, 0 .. 1, where the immersion angle is `upper`.
  [[gnu::always_inline]] ForceLanes up_to(const Lanes& part, const SineAndCosine& upper,
                                          const Line& line) const {
    return force(sum_series<kWorths, kWorths>(kind_, terms_.front().data(), terms_.size(),
                                              variable_.at(part)),
                 upper, line);
  }

  /// The chip forces alone, of all of the piece and up to a part of it.
  [[gnu::always_inline]] ForceLanes chip_of_whole(const SineAndCosine& upper,
                                                  const ChipLanes& chip) const {
    return chip_force(whole_, upper, chip);
  }
  [[gnu::always_inline]] ForceLanes chip_up_to(const Lanes& part, const SineAndCosine& upper,
                                               const ChipLanes& chip) const {
    return chip_force(sum_series<kChipWorths, kWorths>(kind_, terms_.front().data(), terms_.size(),
                                                       variable_.at(part)),
                      upper, chip);
  }

  /// The first kSums of the series that the forces up to a point are made of, at two vectors
  /// abreast.
  template <int kSums>
  [[gnu::always_inline]] std::array<std::array<Lanes, kSums>, 2> sums(
      const std::array<Lanes, 2>& t) const {
    return sum_series<kSums, kWorths>(kind_, terms_.front().data(), terms_.size(), t);
  }

  /// The force of the chip alone, by its sums, up to a point that stands at b.
  template <class Value, std::size_t kCount>
  [[gnu::always_inline]] static ForceLanes chip_force(const std::array<Value, kCount>& w,
                                                      const SineAndCosine& b,
                                                      const ChipLanes& chip) {
    const Lanes c = b.cosine, s = b.sine;
    const Lanes c2 = c * c - s * s, s2 = 2.0 * s * c;
    const Lanes hr = c2 * w[g2r] + s2 * w[g2i];
    const Lanes hi = c2 * w[g2i] - s2 * w[g2r];
    const auto along = [&](int cosine, int sine) -> Lanes {
      return chip.p * (c * w[cosine] + s * w[sine]) + chip.q * (s * w[cosine] - c * w[sine]);
    };
    return {-0.5 * (chip.p * (w[g0r] + hr) + chip.q * (w[g0i] - hi)),
            -0.5 * (chip.p * (w[g0i] + hi) + chip.q * (hr - w[g0r])), along(vc, vs), along(tc, ts)};
  }

  /// And with that of the edge.
  template <class Value>
  [[gnu::always_inline]] static ForceLanes force(const Worths<Value>& w, const SineAndCosine& b,
                                                 const Line& line) {
    const Lanes c = b.cosine, s = b.sine;
    ForceLanes force = chip_force(w, b, line);
    force -= {line.edge * (c * w[er] + s * w[ei]), line.edge * (c * w[ei] - s * w[er]),
              -line.edge * w[ez], -line.edge * w[et]};
    return force;
  }

  /// All of the piece as harmonics of the tip's angle, `shift` ahead of that of the upper end.
  Harmonics whole(const Angle& shift, const LineOfTip& line) const {
    using Complex = std::complex<double>;
    const Worths<double>& w = whole_;
    const Complex behind(shift.cosine, shift.sine);  // exp(-i b) is this times exp(-i tau)
    const Complex g0(w[g0r], w[g0i]), g2 = Complex(w[g2r], w[g2i]) * behind * behind;
    const Complex first =
        -0.5 * (std::conj(line.turning) * g0 + line.turning * g2) - Complex(w[er], w[ei]) * behind;
    const Complex constant = Complex(0.0, 0.5 * line.feed) * g0;
    const Complex second = Complex(0.0, -0.5 * line.feed) * g2;
    const Complex axial = Complex(w[vc], w[vs]) * behind, turning = Complex(w[tc], w[ts]) * behind;
    Harmonics h;
    h.constant = {constant.real(), constant.imag(), (line.turning * axial).real() + w[ez],
                  (line.turning * turning).real() + w[et]};
    h.cos1 = {first.real(), first.imag(), -line.feed * axial.imag(), -line.feed * turning.imag()};
    h.sin1 = {first.imag(), -first.real(), line.feed * axial.real(), line.feed * turning.real()};
    h.cos2 = {second.real(), second.imag(), 0.0, 0.0};
    h.sin2 = {second.imag(), -second.real(), 0.0, 0.0};
    return h;
  }

  /// Terms for steady_up_to(): the upper point stays at an angle, the line is q sin(phi), q [mm].
  SteadyTerms steady_terms(const Angle& upper, double q) const {
    const Line line = {{Lanes{}, Lanes{} + q}, Lanes{} + 1.0};
    SteadyTerms steady;
    steady.reserve(terms_.size());
    for (const Worths<double>& w : terms_) {
      const ForceLanes f = force(w, lanes_of(upper), line);
      steady.push_back({f.x[0], f.y[0], f.z[0], f.torque[0]});
    }
    return steady;
  }

  /// up_to() under the line and at the angle that the terms are of.
  [[gnu::always_inline]] ForceLanes steady_up_to(const Lanes& part,
                                                 const SteadyTerms& terms) const {
    const std::array<Lanes, kRows> sum =
        sum_series<kRows, kRows>(kind_, terms.front().data(), terms.size(), variable_.at(part));
    return {sum[0], sum[1], sum[2], sum[3]};
  }

  /// The variable of sums() and zero_sums() at which they are those of a part.
  [[gnu::always_inline]] Lanes variable_at(const Lanes& part) const { return variable_.at(part); }

  /// The first kSums of the series that up_to_zero() needs: four after four, at two vectors
  /// abreast.
  template <int kSums>
  [[gnu::always_inline]] std::array<std::array<Lanes, kSums>, 2> zero_sums(
      const std::array<Lanes, 2>& t) const {
    std::array<std::array<Lanes, kSums>, 2> sums;
    for (int k = 0; k < kSums; k += kRows) {
      const auto four = sum_series<kRows, kZeroSums>(kind_, zero_terms_.front().data() + k,
                                                     zero_terms_.size(), t);
      for (int i = 0; i < 2; ++i) std::copy(four[i].begin(), four[i].end(), sums[i].begin() + k);
    }
    return sums;
  }

  static constexpr int kChipSums = kRows;  ///< those of the chip alone
  static constexpr int kZeroSums = 8;      ///< with those of the edge

  /// up_to() where the chip is zero at the upper point, b, and so r sin(delta), delta from there
  /// down: the force is then r exp(-i b) times functions of the part alone, and of the edge.
  template <std::size_t kSums>
  [[gnu::always_inline]] static ForceLanes up_to_zero(const Line& line,
                                                      const std::array<Lanes, kSums>& w) {
    // r (cos b, sin b) = (-q, p)
    const Lanes size = square_root(line.p * line.p + line.q * line.q);
    const Lanes r = line.p < 0.0 ? -size : size;
    ForceLanes force = {line.p * w[1] - line.q * w[0], -line.p * w[0] - line.q * w[1], r * w[2],
                        r * w[3]};
    if constexpr (kSums > kChipSums) {
      const Lanes per_r = line.edge / (r == 0.0 ? Lanes{} + 1.0 : r);
      const Lanes c = -line.q * per_r, s = line.p * per_r;
      force -= {c * w[4] + s * w[5], c * w[5] - s * w[4], -line.edge * w[6], -line.edge * w[7]};
    }
    return force;
  }

 private:
  SeriesVariable variable_;
  Terms kind_;
  Worths<double> whole_;
  std::vector<Worths<double>> terms_;
  std::vector<std::array<double, kZeroSums>> zero_terms_;
};

/// A limit of an arc, with what the tooth's own line, which does not turn, is worth there.
class ArcLimit {
 public:
  /// @param own_feed  of a turn [mm]
  ArcLimit(double angle, const RunoutStretch& stretch, double own_feed)
      : stretch_(stretch),
        angle_(angle),
        own_feed_(own_feed),
        terms_(stretch.steady_terms(angle_, own_feed)) {}

  const Angle& angle() const { return angle_; }

  /// The piece from its lower end up to a part of it that stands at the limit. Where the chip is
  /// that of the tooth itself, as at the limits of a slot, one series a row is enough, and none
  /// where there is no chip. Each lane has its own bits, whatever its neighbours.
  [[gnu::always_inline]] ForceLanes up_to(const Lanes& part, const Line& line) const {
    const auto steady = (line.edge == 0.0) | ((line.p == 0.0) & (line.q == own_feed_));
    ForceLanes force;
    if (any(line.edge * (steady ? Lanes{} + 1.0 : Lanes{}) != 0.0)) {
      force = select(steady, stretch_.steady_up_to(part, terms_), force);
      force = {force.x * line.edge, force.y * line.edge, force.z * line.edge,
               force.torque * line.edge};
    }
    if (any(~steady)) {
      force = select(steady, force, stretch_.up_to(part, lanes_of(angle_), line));
    }
    return force;
  }

 private:
  const RunoutStretch& stretch_;
  Angle angle_;
  double own_feed_;  ///< [mm]
  SteadyTerms terms_;
};

/// Entry and exit of each arc, one after the other.
/// @param own_feed  of a turn [mm]
inline std::vector<ArcLimit> limits_of(std::span<const Arc> arcs, const RunoutStretch& stretch,
                                       double own_feed) {
  std::vector<ArcLimit> limits;
  for (const Arc& arc : arcs) {
    limits.emplace_back(arc.entry_angle, stretch, own_feed);
    limits.emplace_back(arc.exit_angle, stretch, own_feed);
  }
  return limits;
}

}  // namespace millstudy::force
