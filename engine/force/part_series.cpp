// SPDX-License-Identifier: MIT
#include "force/part_series.h"

#include <algorithm>
#include <cmath>

namespace millstudy::force {
namespace {

/// Chebyshev coefficients by as many nodes.
std::vector<double> coefficients(const std::function<double(double)>& function, int nodes) {
  const ChebyshevNodes& all = ChebyshevNodes::of(nodes);
  std::vector<double> terms(nodes);
  for (int i = 0; i < nodes; ++i) {
    const double value = function(0.5 + 0.5 * all.node(i));
    for (int m = 0; m < nodes; ++m) terms[m] += all.weight(m, i) * value;
  }
  return terms;
}

}  // namespace

PartSeries::PartSeries(const std::function<double(double)>& function, double negligible) {
  std::vector<double> terms;
  for (const int nodes : ChebyshevNodes::kCounts) {
    terms = coefficients(function, nodes);
    if (std::abs(terms[nodes - 1]) + std::abs(terms[nodes - 2]) <= negligible) break;
  }
  while (terms.size() > 2 && std::abs(terms.back()) <= negligible) terms.pop_back();
  for (const double term : terms) terms_.push_back({term, 0.0});
  for (std::size_t m = terms_.size() - 1; m > 0; --m) {
    terms_[m - 1][1] = 2.0 * static_cast<double>(m) * terms_[m][0] +
                       (m + 1 < terms_.size() ? terms_[m + 1][1] : 0.0);
  }
  terms_[0][1] *= 0.5;
}

PartSeries height_series(const cutter::Envelope& envelope, const EdgePiece& piece) {
  constexpr double kNegligible = 3e-15;  // of the height
  const double lag1 = envelope.lag(piece.bottom), lag2 = envelope.lag(piece.top);
  const double middle = 0.5 * (piece.bottom + piece.top);
  return PartSeries(
      [&](double part) { return envelope.height_at_lag(lag1 + part * (lag2 - lag1)) - middle; },
      kNegligible * piece.top);
}

}  // namespace millstudy::force
