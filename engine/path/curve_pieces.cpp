// SPDX-License-Identifier: MIT
#include "path/curve_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace millstudy::path {
namespace {

constexpr double kMostWeightRatio = 4.0;
constexpr int kDeepestCut = 40;
constexpr int kBendParts = 8;  // |R''| is bounded on each; the hull converges quadratically

using Real = long double;
using Point = std::array<Real, 4>;  // w x, w y, w z, w
using Points = std::vector<Point>;  // shape (degree + 1)

Point blend(const Point& a, const Point& b, Real s) {
  Point c;
  for (int i = 0; i < 4; ++i) c[i] = (1.0L - s) * a[i] + s * b[i];
  return c;
}

Homogeneous rounded(const Point& a) {
  return make_homogeneous(
      {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])},
      static_cast<double>(a[3]));
}

/// Bezier point j of knot span k: the polar form at (begin x (p - j), end x j), equation (P4).
Point polar_form(const CurveData& data, int k, const Points& control, int j) {
  const int p = data.degree;
  Points d = control;
  for (int level = 1; level <= p; ++level) {
    const Real argument = level <= p - j ? data.knots[k] : data.knots[k + 1];
    for (int i = p; i >= level; --i) {
      const Real low = data.knots[k - p + i];
      const Real high = data.knots[k + 1 + i - level];
      d[i] = blend(d[i - 1], d[i], (argument - low) / (high - low));
    }
  }
  return d[p];
}

std::pair<Points, Points> cut(const Points& piece, Real s) {
  Points left = piece;
  Points right = piece;
  const std::size_t p = piece.size() - 1;
  for (std::size_t level = 1; level <= p; ++level) {
    for (std::size_t i = 0; i + level <= p; ++i) right[i] = blend(right[i], right[i + 1], s);
    left[level] = right[0];
  }
  return {left, right};
}

Points differences(const Points& points) {
  Points d(points.size() - 1);
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (int c = 0; c < 4; ++c) d[i][c] = points[i + 1][c] - points[i][c];
  }
  return d;
}

/// Power form about the middle, t in [-1, 1]. Coefficient k is the k-th derivative at the middle
/// over k!, and that is the end of the right half's k-th difference: (P5).
std::vector<Homogeneous> power_form(const Points& bezier) {
  const int p = static_cast<int>(bezier.size()) - 1;
  Points difference = cut(bezier, 0.5L).second;  // the right half, of length 1 in t
  std::vector<Homogeneous> power;
  Real binomial = 1.0L;
  for (int k = 0; k <= p; ++k) {
    const Point& d = difference[0];
    power.push_back(rounded({binomial * d[0], binomial * d[1], binomial * d[2], binomial * d[3]}));
    binomial *= static_cast<Real>(p - k) / (k + 1);
    if (k < p) difference = differences(difference);
  }
  return power;
}

Real size(const Point& p) {
  return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

/// Upper bound of |d2R/dt2| by the hulls of N'', w', w'' about the first point: (P6).
Real bend_bound(const Points& piece) {
  const Real p = static_cast<Real>(piece.size() - 1);
  Points local = piece;
  for (Point& b : local) {
    for (int c = 0; c < 3; ++c) b[c] -= b[3] * piece[0][c] / piece[0][3];
  }
  Real reach = 0.0L;
  Real least = local[0][3];
  for (const Point& b : local) {
    reach = std::max(reach, size(b) / b[3]);
    least = std::min(least, b[3]);
  }
  const auto largest = [](const Points& points, Real factor) {
    std::pair<Real, Real> bound{0.0L, 0.0L};
    for (const Point& d : points) {
      bound.first = std::max(bound.first, factor * size(d));
      bound.second = std::max(bound.second, factor * std::abs(d[3]));
    }
    return bound;
  };
  const Points once = differences(local);
  const auto [n1, w1] = largest(once, p / 2);
  Real n2 = 0.0L;
  Real w2 = 0.0L;
  if (once.size() > 1) std::tie(n2, w2) = largest(differences(once), p * (p - 1) / 4);
  const Real speed = (n1 + w1 * reach) / least;
  return (n2 + 2 * w1 * speed + w2 * reach) / least;
}

Real bend_bound_of_parts(Points piece) {
  Real bound = 0.0L;
  for (int part = kBendParts; part >= 1; --part) {
    auto [left, right] = part > 1 ? cut(piece, 1.0L / part) : std::pair{piece, piece};
    bound = std::max(bound, bend_bound(left) * (kBendParts * kBendParts));
    piece = std::move(right);
  }
  return bound;
}

void add_pieces(const Points& bezier, double begin, double end, const Vec3& origin, int depth,
                std::vector<Piece>& pieces) {
  const auto by_weight = [](const Point& a, const Point& b) { return a[3] < b[3]; };
  const auto [least, most] = std::minmax_element(bezier.begin(), bezier.end(), by_weight);
  const double middle = begin + 0.5 * (end - begin);
  if ((*most)[3] > kMostWeightRatio * (*least)[3] && depth < kDeepestCut) {
    const auto [left, right] = cut(bezier, 0.5L);
    add_pieces(left, begin, middle, origin, depth + 1, pieces);
    add_pieces(right, middle, end, origin, depth + 1, pieces);
    return;
  }
  Piece piece;
  piece.begin = begin;
  piece.end = end;
  piece.origin = origin;
  for (const Point& b : bezier) piece.bezier.push_back(rounded(b));
  piece.power = power_form(bezier);
  piece.bend = static_cast<double>(bend_bound_of_parts(bezier)) * (1.0 + 1e-12);
  pieces.push_back(std::move(piece));
}

/// Equal weights come out of the recursions as 1 to rounding; exactly 1 spares the division.
void remove_rounding_of_weights(Piece& piece) {
  for (Homogeneous& b : piece.bezier) b.v[3] = 1.0;
  for (std::size_t i = 0; i < piece.power.size(); ++i) piece.power[i].v[3] = i == 0 ? 1.0 : 0.0;
}

}  // namespace

std::vector<Piece> make_pieces(const CurveData& data) {
  const int p = data.degree;
  const int n = static_cast<int>(data.points.size());
  std::vector<Piece> pieces;
  for (int k = p; k < n; ++k) {
    if (!(data.knots[k + 1] > data.knots[k])) continue;
    const Vec3 origin = data.points[k - p / 2];
    Points control(p + 1);
    Real scale = 0.0L;  // weights relative to the largest one of the span
    for (int i = 0; i <= p; ++i) {
      scale = std::max<Real>(scale, data.weights.empty() ? 1.0 : data.weights[k - p + i]);
    }
    for (int i = 0; i <= p; ++i) {
      const Vec3& q = data.points[k - p + i];
      const Real w = (data.weights.empty() ? 1.0 : data.weights[k - p + i]) / scale;
      control[i] = {w * (static_cast<Real>(q.x) - origin.x),
                    w * (static_cast<Real>(q.y) - origin.y),
                    w * (static_cast<Real>(q.z) - origin.z), w};
    }
    Points bezier(p + 1);
    for (int j = 0; j <= p; ++j) bezier[j] = polar_form(data, k, control, j);
    const bool polynomial =
        std::all_of(control.begin(), control.end(), [](const Point& c) { return c[3] == 1.0L; });
    const std::size_t first = pieces.size();
    add_pieces(bezier, data.knots[k], data.knots[k + 1], origin, 0, pieces);
    if (polynomial) remove_rounding_of_weights(pieces[first]);
  }
  return pieces;
}

}  // namespace millstudy::path
