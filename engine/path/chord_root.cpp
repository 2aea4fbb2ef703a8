// SPDX-License-Identifier: MIT
#include "path/chord_root.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "path/bernstein.h"

namespace millstudy::path {
namespace {

constexpr int kDeepest = 52;
constexpr int kMostPieces = 20000;  // the worst of a million random cases took 109
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

using ChordPolynomial = std::array<double, 2 * kHighestDegree + 1>;
using Pascal = std::array<std::array<double, 2 * kHighestDegree + 1>, 2 * kHighestDegree + 1>;

constexpr Pascal make_pascal() {
  Pascal rows{};
  for (std::size_t n = 0; n < rows.size(); ++n) {
    rows[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k) rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
  }
  return rows;
}
constexpr Pascal kBinomial = make_pascal();

/// One piece of the chord polynomial: N - w P in xyz, chord w in w.
struct ChordPiece {
  BezierPoints points;
  double band;  // relative rounding of (chord w)^2: what is within it counts as zero
};

/// The band for a whole piece, from its smallest weight (weights vary fourfold at most).
double piece_band(const BezierPoints& m, int degree, double band) {
  double least = m[0].w();
  for (int i = 1; i <= degree; ++i) least = std::min(least, m[i].w());
  return band * least * least;
}

/// (P12) on span k between t0 and t1; `from` is about the origin of the span.
ChordPiece chord_piece(const Curve& curve, std::size_t k, double t0, double t1,
                       const Homogeneous& from, double chord) {
  const int p = curve.degree();
  const std::span<const Homogeneous> bezier = curve.bezier(k);
  ChordPiece piece{};
  double reach = 0.0;
  for (int i = 0; i <= p; ++i) {
    const double w = bezier[i].w();
    const Vec3 numerator = (bezier[i] - from * w).xyz();
    piece.points[i] = make_homogeneous(numerator, chord * w);
    reach = std::max(reach, norm(numerator) / w);
  }
  piece.band = 16.0 * kEpsilon * (reach + chord) / chord;
  if (t0 > -1.0) piece.points = split(piece.points, p, 0.5 * (t0 + 1.0)).right;
  if (t1 < 1.0) piece.points = split(piece.points, p, (t1 - t0) / (1.0 - t0)).left;
  return piece;
}

/// (P13): Bernstein coefficients of G on the piece, shape (2 degree + 1) in use.
ChordPolynomial chord_polynomial(const BezierPoints& m, int p) {
  ChordPolynomial g{};
  for (int i = 0; i <= p; ++i) {
    const Homogeneous mirrored = make_homogeneous(m[i].xyz(), -m[i].w());
    g[2 * i] += kBinomial[p][i] * kBinomial[p][i] * dot(mirrored, m[i]);
    for (int j = i + 1; j <= p; ++j) {
      g[i + j] += 2.0 * kBinomial[p][i] * kBinomial[p][j] * dot(mirrored, m[j]);
    }
  }
  for (int k = 0; k <= 2 * p; ++k) g[k] /= kBinomial[2 * p][k];
  return g;
}

/// Counts changes of sign of a sequence, leaving out what is zero to rounding.
struct SignCounter {
  int changes = 0;
  int last = 0;
  void add(int sign) {
    if (sign == 0) return;
    if (last != 0 && sign != last) ++changes;
    last = sign;
  }
};

int sign_of(double g, double band) {
  return g < -band ? -1 : (g > band ? 1 : 0);
}

/// Depth first, left before right: (P14).
class FirstRootSearch {
 public:
  FirstRootSearch(int degree, double band, RootBracket& out)
      : degree_(degree), band_(band), out_(out) {}

  bool search(const BezierPoints& m, double low, double high, int depth) {
    ++out_.pieces;
    const ChordPolynomial g = chord_polynomial(m, degree_);
    if (g[0] >= -band_of(m[0])) return accept(low, low);
    SignCounter signs;
    const double band = piece_band(m, degree_, band_);
    for (int k = 0; k < 2 * degree_; ++k) signs.add(sign_of(g[k], band));
    const bool reached = g[2 * degree_] >= -band_of(m[degree_]);
    signs.add(reached ? 1 : -1);
    if (signs.changes == 0) return false;
    if (signs.changes == 1) return accept(low, high);
    if (depth >= kDeepest || out_.pieces >= kMostPieces) return reached && accept(low, high);
    const double middle = 0.5 * (low + high);
    const BezierHalves halves = split(m, degree_, 0.5);
    return search(halves.left, low, middle, depth + 1) ||
           search(halves.right, middle, high, depth + 1);
  }

 private:
  double band_of(const Homogeneous& m) const { return band_ * m.w() * m.w(); }
  bool accept(double low, double high) {
    out_.found = true;
    out_.low = low;
    out_.high = high;
    return true;
  }

  int degree_;
  double band_;
  RootBracket& out_;
};

}  // namespace

RootBracket first_chord_root(const Curve& curve, Cursor start, const Homogeneous& from,
                             double chord) {
  RootBracket out;
  for (std::size_t k = start.span; k < curve.spans().size(); ++k) {
    const double t0 = k == start.span ? std::max(start.t, -1.0) : -1.0;
    if (t0 >= 1.0) continue;
    const Homogeneous local = from + curve.offset(start.span, k);
    const ChordPiece piece = chord_piece(curve, k, t0, 1.0, local, chord);
    out.span = k;
    FirstRootSearch search(curve.degree(), piece.band, out);
    if (search.search(piece.points, t0, 1.0, 0)) break;
  }
  return out;
}

int chord_sign_changes(const Curve& curve, Cursor start, const Homogeneous& from, Cursor stop,
                       double chord) {
  SignCounter signs;
  for (std::size_t k = start.span; k <= stop.span; ++k) {
    const double t0 = k == start.span ? std::max(start.t, -1.0) : -1.0;
    const double t1 = k == stop.span ? std::min(stop.t, 1.0) : 1.0;
    if (!(t1 > t0)) continue;
    const Homogeneous local = from + curve.offset(start.span, k);
    const ChordPiece piece = chord_piece(curve, k, t0, t1, local, chord);
    const ChordPolynomial g = chord_polynomial(piece.points, curve.degree());
    const double band = piece_band(piece.points, curve.degree(), piece.band);
    for (int i = 0; i <= 2 * curve.degree(); ++i) signs.add(sign_of(g[i], band));
  }
  return signs.changes;
}

}  // namespace millstudy::path
