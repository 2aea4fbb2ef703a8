// SPDX-License-Identifier: MIT
#include "path/arc_length.h"

#include <cmath>
#include <cstddef>

#include "core/quadrature.h"

namespace millstudy::path {
namespace {

constexpr int kNodes = 16;
constexpr int kDeepest = 48;
constexpr double kTolerance = 1e-13;

double gauss(const Curve& curve, std::size_t span, double a, double b) {
  const core::GaussRule& rule = core::gauss_legendre(kNodes);
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  double sum = 0.0;
  for (int i = 0; i < kNodes; ++i) {
    const Homogeneous d = curve.local({span, middle + half * rule.nodes[i]}).first;
    sum += rule.weights[i] * std::sqrt(dot(d, d));
  }
  return half * sum;
}

double adaptive(const Curve& curve, std::size_t span, double a, double b, double whole,
                double scale, int depth) {
  const double middle = 0.5 * (a + b);
  const double left = gauss(curve, span, a, middle);
  const double right = gauss(curve, span, middle, b);
  const double error = std::abs(left + right - whole);
  // |R'| itself is only known to span.rest: asking for more would halve noise without end.
  const double noise = curve.spans()[span].rest * (b - a);
  if (error <= kTolerance * scale + noise || depth >= kDeepest) {
    return left + right;
  }
  return adaptive(curve, span, a, middle, left, scale, depth + 1) +
         adaptive(curve, span, middle, b, right, scale, depth + 1);
}

}  // namespace

double arc_length(const Curve& curve, double from, double to) {
  const Cursor first = curve.locate(from);
  const Cursor last = curve.locate(to, first.span);
  const auto low = [&](std::size_t k) { return k == first.span ? first.t : -1.0; };
  const auto high = [&](std::size_t k) { return k == last.span ? last.t : 1.0; };
  double scale = 0.0;
  for (std::size_t k = first.span; k <= last.span; ++k) {
    if (high(k) > low(k)) scale += gauss(curve, k, low(k), high(k));
  }
  double length = 0.0;
  for (std::size_t k = first.span; k <= last.span; ++k) {
    if (!(high(k) > low(k))) continue;
    const double whole = gauss(curve, k, low(k), high(k));
    length += adaptive(curve, k, low(k), high(k), whole, scale, 0);
  }
  return length;
}

}  // namespace millstudy::path
