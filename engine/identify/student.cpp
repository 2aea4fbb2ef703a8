// SPDX-License-Identifier: MIT
#include "identify/student.h"

#include <cmath>

#include "core/quadrature.h"
#include "core/units.h"

namespace millstudy::identify {

double student_975(double degrees_of_freedom) {
  // With t = sqrt(n) tan(a) the density is that of cos(a)^(n - 1); Newton's method on its integral.
  const double n = degrees_of_freedom;
  const double whole =
      std::sqrt(core::kPi) * std::exp(std::lgamma(0.5 * n) - std::lgamma(0.5 * (n + 1.0)));
  const core::GaussRule& rule = core::gauss_legendre(60);
  const auto density = [&](double a) { return std::pow(std::cos(a), n - 1.0) / whole; };
  double a = std::atan(1.96 / std::sqrt(n));
  for (int i = 0; i < 60; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      sum += 0.5 * a * rule.weights[k] * density(0.5 * a * (1.0 + rule.nodes[k]));
    }
    const double step = (0.475 - sum) / density(a);
    a += step;
    if (std::abs(step) <= 1e-15 * a) break;
  }
  return std::sqrt(n) * std::tan(a);
}

}  // namespace millstudy::identify
