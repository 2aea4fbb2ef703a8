// SPDX-License-Identifier: MIT
#include "force/edge_moments.h"

#include <algorithm>

namespace millstudy::force {
namespace {

// Of the largest term. Rounding leaves up to 3e-16 in the terms of every order: a smaller number
// would keep dozens that are nothing else.
constexpr double kNegligible = 3e-16;
constexpr double kResolved = 1e-15;  // the last terms: more points would not help

/// How a load on a column turns into rows: a force in the plane of -exp(-i phi) times the planar
/// weight, turned by a quarter for r and a; and along the axis, of t the torque, of r and a z.
struct Weights {
  std::array<double, kColumns> planar;
  std::array<double, kColumns> axial;
};

/// (F4) and (F20) in these terms: the moment about the tip is i z times the planar force plus
/// r exp(-i phi) times the axial one.
Weights weights_of(Rows rows, const EdgeNode& n) {
  if (rows == Rows::moments) {
    return {{n.z, n.z * n.sin_kappa + n.radius * n.cos_kappa,
             n.z * n.cos_kappa - n.radius * n.sin_kappa},
            {}};
  }
  return {{1.0, n.sin_kappa, n.cos_kappa}, {n.radius, n.cos_kappa, -n.sin_kappa}};
}

void rotate(double& c, double& s, double cosine, double sine) {
  const double turned = c * cosine - s * sine;
  s = s * cosine + c * sine;
  c = turned;
}

}  // namespace

NodeLoads loads_of_feeds(const CuttingEdges& edges, int flute, const EdgeNode& node) {
  const double ratio = edges.pitch_ratio(flute, node.lag);
  return {ratio * node.sin_kappa * node.width, -ratio * node.cos_kappa * node.width, node.length};
}

EdgeMoments EdgeMoments::of(const CuttingEdges& edges, Rows rows, int flute, const EdgeNode& node,
                            double delta) {
  const Weights weights = weights_of(rows, node);
  const std::array<double, 6> factors = edges.factors(flute, node);
  const double c1 = std::cos(delta), s1 = std::sin(delta);
  const double c2 = c1 * c1 - s1 * s1, s2 = 2.0 * s1 * c1;
  EdgeMoments moments;
  for (int q = 0; q < kColumns; ++q) {
    const double chip_planar = factors[q] * weights.planar[q];
    const double chip_axial = factors[q] * weights.axial[q];
    const double edge_planar = factors[kColumns + q] * weights.planar[q];
    const std::array<double, kChip> chip = {chip_planar, chip_planar * c2, chip_planar * s2,
                                            chip_axial * c1, chip_axial * s1};
    const std::array<double, kStill> edge = {edge_planar * c1, edge_planar * s1,
                                             factors[kColumns + q] * weights.axial[q]};
    const std::array<double, kStill> plunge = {chip_planar * c1, chip_planar * s1, chip_axial};
    const auto first = moments.values_.begin();
    std::copy(chip.begin(), chip.end(), first + kChip * q);
    std::copy(edge.begin(), edge.end(), first + kEdge + kStill * q);
    std::copy(plunge.begin(), plunge.end(), first + kPlunge + kStill * q);
  }
  return moments;
}

void EdgeMoments::add(const EdgeMoments& unit, const NodeLoads& loads) {
  for (int k = 0; k < kEdge; ++k) values_[k] += loads.chip * unit.values_[k];
  for (int k = kEdge; k < kPlunge; ++k) values_[k] += loads.edge * unit.values_[k];
  for (int k = kPlunge; k < kCount; ++k) values_[k] += loads.still * unit.values_[k];
}

void EdgeMoments::turn(double cos_lag, double sin_lag) {
  // delta, negative for places below the point of a right-hand edge, falls by the lag.
  const double c1 = cos_lag, s1 = -sin_lag;
  const double c2 = c1 * c1 - s1 * s1, s2 = 2.0 * s1 * c1;
  for (int q = 0; q < kColumns; ++q) {
    double* chip = &values_[kChip * q];
    rotate(chip[1], chip[2], c2, s2);
    rotate(chip[3], chip[4], c1, s1);
    rotate(values_[kEdge + kStill * q], values_[kEdge + kStill * q + 1], c1, s1);
    rotate(values_[kPlunge + kStill * q], values_[kPlunge + kStill * q + 1], c1, s1);
  }
}

Basis<double> EdgeMoments::basis(Rows rows, double cos_b, double sin_b) const {
  const double cos_2b = cos_b * cos_b - sin_b * sin_b, sin_2b = 2.0 * sin_b * cos_b;
  Basis<double> basis;
  const auto put = [&](Matrix43<double>& to, int q, double x, double y, double axial) {
    if (q != 0) {  // r and a stand a quarter turn from t
      const double turned = -y;
      y = x;
      x = turned;
    }
    if (rows == Rows::moments) {  // times i once more
      const double turned = -y;
      y = x;
      x = turned;
    }
    to[0][q] = x;
    to[1][q] = y;
    to[q == 0 ? 3 : 2][q] = axial;
  };
  for (int q = 0; q < kColumns; ++q) {
    // -sin(phi) exp(-i phi) = i/2 (1 - exp(-2 i b) exp(2 i delta))
    const double real = chip(q, 0) - (cos_2b * chip(q, 1) + sin_2b * chip(q, 2));
    const double imaginary = sin_2b * chip(q, 1) - cos_2b * chip(q, 2);
    put(basis.chip, q, -0.5 * imaginary, 0.5 * real, sin_b * chip(q, 3) - cos_b * chip(q, 4));
    // -exp(-i phi) = -exp(-i b) exp(i delta)
    const auto put_still = [&](Matrix43<double>& to, double c, double s, double axial) {
      put(to, q, -(cos_b * c + sin_b * s), sin_b * c - cos_b * s, axial);
    };
    put_still(basis.edge, edge(q, 0), edge(q, 1), edge(q, 2));
    put_still(basis.plunge, plunge(q, 0), plunge(q, 1), plunge(q, 2));
  }
  return basis;
}

namespace {

SeriesVariable variable_of(const EdgePiece& piece) {
  constexpr double kFar = 3.0;
  if (!piece.segment.is_arc) return SeriesVariable::linear();
  // The lowest point of the arc below the lower end, in units of the piece.
  const double lowest = piece.segment.centre_height - piece.segment.corner_radius;
  const double base = (piece.bottom - lowest) / (piece.top - piece.bottom);
  if (base > kFar) return SeriesVariable::linear();
  // An arc that begins at its lowest point may miss it by rounding.
  const bool misses = piece.bottom == 0.0 && base < 1e-9;
  return SeriesVariable::of_root(misses ? 0.0 : std::max(0.0, base));
}

/// Chebyshev coefficients of values at the nodes.
std::vector<EdgeMoments> chebyshev(const ChebyshevNodes& all,
                                   const std::vector<EdgeMoments>& values) {
  const int nodes = static_cast<int>(values.size()), half = nodes / 2;
  // Of values at opposite nodes even terms have the sum, odd ones the difference.
  std::array<std::vector<EdgeMoments>, 2> pairs = {std::vector<EdgeMoments>(half),
                                                   std::vector<EdgeMoments>(half)};
  for (int i = 0; i < half; ++i) {
    const auto &one = values[i].values(), &opposite = values[nodes - 1 - i].values();
    for (int k = 0; k < EdgeMoments::kCount; ++k) {
      pairs[0][i].values()[k] = one[k] + opposite[k];
      pairs[1][i].values()[k] = one[k] - opposite[k];
    }
  }
  std::vector<EdgeMoments> terms(nodes);
  for (int m = 0; m < nodes; ++m) {
    auto& sum = terms[m].values();
    for (int i = 0; i < half; ++i) {
      const double factor = all.weight(m, i);
      const auto& pair = pairs[m % 2][i].values();
      for (int k = 0; k < EdgeMoments::kCount; ++k) sum[k] += factor * pair[k];
    }
  }
  return terms;
}

double largest(const EdgeMoments& moments) {
  double most = 0.0;
  for (const double value : moments.values()) most = std::max(most, std::abs(value));
  return most;
}

/// Makes the terms factors of powers where that loses no more than a digit: powers of t have up to
/// (1 + sqrt(2))^m times the factor of their Chebyshev polynomial.
void turn_to_powers(MomentSeries& series) {
  constexpr double kMostGrowth = 16.0;
  double most = 0.0, sum = 0.0, growth = 1.0;
  for (const EdgeMoments& term : series.terms) {
    most = std::max(most, largest(term));
    sum += growth * largest(term);
    growth *= 1.0 + std::sqrt(2.0);
  }
  if (!(sum <= kMostGrowth * most)) return;
  // Clenshaw's recurrence, on polynomials: next = term + 2 t one - two.
  const auto count = series.terms.size();
  std::vector<EdgeMoments> one(count), two(count);
  for (std::size_t m = count - 1; m > 0; --m) {
    for (std::size_t power = count - m; power-- > 0;) {  // two takes the place of one
      auto& next = two[power].values();
      for (int k = 0; k < EdgeMoments::kCount; ++k) {
        next[k] = -next[k] + (power > 0 ? 2.0 * one[power - 1].values()[k] : 0.0) +
                  (power == 0 ? series.terms[m].values()[k] : 0.0);
      }
    }
    std::swap(one, two);
  }
  for (std::size_t power = count; power-- > 0;) {
    auto& sum_of = series.terms[power].values();
    for (int k = 0; k < EdgeMoments::kCount; ++k) {
      const double constant = power == 0 ? sum_of[k] : 0.0;
      sum_of[k] =
          constant + (power > 0 ? one[power - 1].values()[k] : 0.0) - two[power].values()[k];
    }
  }
  series.kind = Terms::powers;
}

using LoadsOf = std::function<void(const EdgeNode&, std::span<NodeLoads>)>;

/// Moments from the lower end on, up to a point that goes up.
class Growing {
 public:
  Growing(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece, int count,
          const LoadsOf& loads_of)
      : edges_(edges),
        rows_(rows),
        flute_(flute),
        piece_(piece),
        loads_of_(loads_of),
        tangent_(edges.flutes()[flute].helix_tangent),
        height_(piece.bottom),
        loads_(count),
        moments_(count) {}

  const std::vector<EdgeMoments>& at(double z) {
    if (z <= height_) return moments_;
    const double lag = edges_.envelope().lag(z);
    const double further = tangent_ * (lag - edges_.envelope().lag(height_));
    const double cosine = std::cos(further), sine = std::sin(further);
    for (EdgeMoments& moments : moments_) moments.turn(cosine, sine);
    edges_.for_each_node(piece_, tangent_, height_, z, [&](const EdgeNode& node) {
      loads_of_(node, loads_);
      const EdgeMoments unit =
          EdgeMoments::of(edges_, rows_, flute_, node, tangent_ * (node.lag - lag));
      for (std::size_t i = 0; i < moments_.size(); ++i) moments_[i].add(unit, loads_[i]);
    });
    height_ = z;
    return moments_;
  }

 private:
  const CuttingEdges& edges_;
  Rows rows_;
  int flute_;
  const EdgePiece& piece_;
  const LoadsOf& loads_of_;
  double tangent_;
  double height_;
  std::vector<NodeLoads> loads_;
  std::vector<EdgeMoments> moments_;
};

/// Drops what is nothing beside the largest term.
/// @return whether the terms fell so far
bool finish(MomentSeries& series) {
  double most = 0.0;
  for (const EdgeMoments& term : series.terms) most = std::max(most, largest(term));
  const std::size_t nodes = series.terms.size();
  const double tail = std::max(largest(series.terms[nodes - 1]), largest(series.terms[nodes - 2]));
  while (series.terms.size() > 1 && largest(series.terms.back()) < kNegligible * most) {
    series.terms.pop_back();
  }
  series.terms.shrink_to_fit();
  turn_to_powers(series);
  return tail <= kResolved * most;
}

}  // namespace

MomentSeries moment_series(const CuttingEdges& edges, Rows rows, int flute,
                           const EdgePiece& piece) {
  return moment_series(edges, rows, flute, piece, 1,
                       [&](const EdgeNode& node, std::span<NodeLoads> loads) {
                         loads[0] = loads_of_feeds(edges, flute, node);
                       })[0];
}

std::vector<MomentSeries> moment_series(const CuttingEdges& edges, Rows rows, int flute,
                                        const EdgePiece& piece, int count, const LoadsOf& loads) {
  const SeriesVariable variable = variable_of(piece);
  const double lag1 = edges.envelope().lag(piece.bottom);
  const double lag2 = edges.envelope().lag(piece.top);
  for (const int nodes : ChebyshevNodes::kCounts) {
    std::vector<MomentSeries> all(count, {variable, Terms::chebyshev, {}, {}});
    for (MomentSeries& series : all) series.terms.resize(nodes);
    const ChebyshevNodes& chebyshev_nodes = ChebyshevNodes::of(nodes);
    Growing edge(edges, rows, flute, piece, count, loads);
    for (int i = nodes - 1; i >= 0; --i) {  // upward
      const double part = variable.part_at(chebyshev_nodes.node(i));
      const std::vector<EdgeMoments>& moments = edge.at(std::clamp(
          edges.envelope().height_at_lag(lag1 + part * (lag2 - lag1)), piece.bottom, piece.top));
      for (int k = 0; k < count; ++k) all[k].terms[i] = moments[k];
    }
    const std::vector<EdgeMoments>& whole = edge.at(piece.top);
    bool resolved = true;
    for (int k = 0; k < count; ++k) {
      all[k].whole = whole[k];
      all[k].terms = chebyshev(chebyshev_nodes, all[k].terms);
      resolved &= finish(all[k]);
    }
    if (resolved || nodes == ChebyshevNodes::kCounts.back()) return all;
  }
  __builtin_unreachable();
}

}  // namespace millstudy::force
