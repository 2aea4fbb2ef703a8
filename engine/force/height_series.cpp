// SPDX-License-Identifier: MIT
#include "force/height_series.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace millstudy::force {

HeightSeries::HeightSeries(const cutter::Envelope& envelope, const EdgePiece& piece) {
  constexpr int kNodes = 24;
  constexpr double kNegligible = 3e-15;  // of the height: rounding leaves as much in every term
  const double lag1 = envelope.lag(piece.bottom), lag2 = envelope.lag(piece.top);
  const double middle = 0.5 * (piece.bottom + piece.top);
  terms_.resize(kNodes);
  for (int i = 0; i < kNodes; ++i) {
    const double angle = core::kPi * (i + 0.5) / kNodes;
    const double part = 0.5 + 0.5 * std::cos(angle);
    const double height = envelope.height_at_lag(lag1 + part * (lag2 - lag1)) - middle;
    for (int m = 0; m < kNodes; ++m) {
      terms_[m][0] += (m == 0 ? 1.0 : 2.0) / kNodes * std::cos(m * angle) * height;
    }
  }
  while (terms_.size() > 2 && std::abs(terms_.back()[0]) < kNegligible * piece.top) {
    terms_.pop_back();
  }
  for (std::size_t m = terms_.size() - 1; m > 0; --m) {
    terms_[m - 1][1] = 2.0 * static_cast<double>(m) * terms_[m][0] +
                       (m + 1 < terms_.size() ? terms_[m + 1][1] : 0.0);
  }
  terms_[0][1] *= 0.5;
}

double HeightSeries::steepest() const {
  return std::max(std::abs(at(Lanes{}).slope[0]), std::abs(at(Lanes{} + 1.0).slope[0]));
}

}  // namespace millstudy::force
