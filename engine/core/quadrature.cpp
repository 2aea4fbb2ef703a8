// SPDX-License-Identifier: MIT
#include "core/quadrature.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "core/units.h"

namespace millstudy::core {
namespace {

struct Legendre {
  long double value;
  long double slope;
};

Legendre legendre(int n, long double x) {
  long double previous = 0.0L;
  long double value = 1.0L;
  for (int k = 1; k <= n; ++k) {
    const long double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (x * value - previous) / (x * x - 1.0L)};
}

GaussRule make_rule(int n) {
  GaussRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (int i = 0; i < n; ++i) {
    // The classical first guess is good to a few digits; five Newton steps reach long double.
    long double x = -std::cos(static_cast<long double>(kPi) * (i + 0.75L) / (n + 0.5L));
    for (int step = 0; step < 5; ++step) {
      const Legendre p = legendre(n, x);
      x -= p.value / p.slope;
    }
    const long double slope = legendre(n, x).slope;
    rule.nodes[i] = static_cast<double>(x);
    rule.weights[i] = static_cast<double>(2.0L / ((1.0L - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace

const GaussRule& gauss_legendre(int n) {
  assert(1 <= n && n <= kLargestGaussRule);
  static const std::array<GaussRule, kLargestGaussRule + 1> rules = [] {
    std::array<GaussRule, kLargestGaussRule + 1> all;
    for (int k = 1; k <= kLargestGaussRule; ++k) all[k] = make_rule(k);
    return all;
  }();
  return rules[n];
}

}  // namespace millstudy::core
