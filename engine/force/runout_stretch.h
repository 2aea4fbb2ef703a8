// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "force/coefficients.h"
#include "force/edge_moments.h"
#include "force/lanes_math.h"

/// (F25): the force of a stretch of edge whose chip is linear in cos(phi) and sin(phi).
namespace millstudy::force {

/// Over sin(kappa), the chip of one reach is P cos(phi) + Q sin(phi), (F23), and edge forces act
/// where it is positive. All zero: no chip.
struct Line {
  Lanes p{};
  Lanes q{};
  Lanes edge{};  ///< 1 or 0

  Lanes at(const SineAndCosine& phi) const { return p * phi.cosine + q * phi.sine; }
};

inline Line operator-(const Line& a, const Line& b) {
  return {a.p - b.p, a.q - b.q, a.edge - b.edge};
}

template <class Mask>
[[gnu::always_inline]] inline Line select(const Mask& mask, const Line& a, const Line& b) {
  return {mask ? a.p : b.p, mask ? a.q : b.q, mask ? a.edge : b.edge};
}

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
    for (const EdgeMoments& term : series.terms) terms_.push_back(worths(term, k, cosine, sine));
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

 private:
  template <class Value>
  [[gnu::always_inline]] static ForceLanes force(const Worths<Value>& w, const SineAndCosine& b,
                                                 const Line& line) {
    const Lanes c = b.cosine, s = b.sine;
    const Lanes c2 = c * c - s * s, s2 = 2.0 * s * c;
    const Lanes hr = c2 * w[g2r] + s2 * w[g2i];
    const Lanes hi = c2 * w[g2i] - s2 * w[g2r];
    const auto along = [&](int cosine, int sine) -> Lanes {
      return line.p * (c * w[cosine] + s * w[sine]) + line.q * (s * w[cosine] - c * w[sine]);
    };
    return {-0.5 * (line.p * (w[g0r] + hr) + line.q * (w[g0i] - hi)) -
                line.edge * (c * w[er] + s * w[ei]),
            -0.5 * (line.p * (w[g0i] + hi) + line.q * (hr - w[g0r])) -
                line.edge * (c * w[ei] - s * w[er]),
            along(vc, vs) + line.edge * w[ez], along(tc, ts) + line.edge * w[et]};
  }

  static Worths<double> worths(const EdgeMoments& m, const Coefficients& k, double cosine,
                               double sine) {
    Worths<double> w;
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
    for (const int real : {g0r, g2r, er}) {
      const double turned = w[real] * cosine - w[real + 1] * sine;
      w[real + 1] = w[real] * sine + w[real + 1] * cosine;
      w[real] = turned;
    }
    return w;
  }

  SeriesVariable variable_;
  Terms kind_;
  Worths<double> whole_;
  std::vector<Worths<double>> terms_;
};

}  // namespace millstudy::force
