// SPDX-License-Identifier: MIT
#include "path/arc_length_table.h"

#include <algorithm>
#include <cmath>

#include "core/quadrature.h"

namespace millstudy::path {
namespace {

constexpr int kNodes = 5;

double speed(const Curve& curve, double u, std::size_t& hint) {
  const Cursor at = curve.locate(u, hint);
  hint = at.span;
  const Homogeneous first = curve.local(at).first;
  return curve.spans()[at.span].inverse_half * std::sqrt(dot(first, first));
}

}  // namespace

ArcLengthTable::ArcLengthTable(const Curve& curve, int intervals) {
  const core::GaussRule& rule = core::gauss_legendre(kNodes);
  const double width = curve.end() - curve.begin();
  std::size_t hint = 0;
  std::vector<double> speeds;
  for (int i = 0; i <= intervals; ++i) {
    const double u = i == intervals ? curve.end() : curve.begin() + width * i / intervals;
    double length = 0.0;
    if (i > 0) {
      const double before = parameters_.back();
      const double half = 0.5 * (u - before);
      for (int n = 0; n < kNodes; ++n) {
        length +=
            half * rule.weights[n] * speed(curve, before + half * (1.0 + rule.nodes[n]), hint);
      }
      length += lengths_.back();
    }
    lengths_.push_back(length);
    parameters_.push_back(u);
    speeds.push_back(speed(curve, u, hint));
  }
  evaluations_ = static_cast<std::int64_t>(intervals) * (kNodes + 1) + 1;
  for (int i = 0; i <= intervals; ++i) {
    const auto secant = [&](int k) {
      return (parameters_[k + 1] - parameters_[k]) / (lengths_[k + 1] - lengths_[k]);
    };
    double limit = std::min(i > 0 ? secant(i - 1) : HUGE_VAL, i < intervals ? secant(i) : HUGE_VAL);
    limit *= 3.0;
    slopes_.push_back(speeds[i] * limit > 1.0 ? 1.0 / speeds[i] : limit);
  }
}

double ArcLengthTable::parameter(double s, std::size_t& hint) const {
  std::size_t k = hint;
  if (s < lengths_[k]) k = 0;
  while (k + 2 < lengths_.size() && s >= lengths_[k + 1]) ++k;
  hint = k;
  const double width = lengths_[k + 1] - lengths_[k];
  if (!(width > 0.0)) return parameters_[k + 1];
  const double x = std::clamp((s - lengths_[k]) / width, 0.0, 1.0);
  const double y = 1.0 - x;
  // Cubic Hermite
  return parameters_[k] * y * y * (1.0 + 2.0 * x) + parameters_[k + 1] * x * x * (1.0 + 2.0 * y) +
         width * x * y * (slopes_[k] * y - slopes_[k + 1] * x);
}

}  // namespace millstudy::path
