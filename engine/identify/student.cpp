// SPDX-License-Identifier: MIT
#include "identify/student.h"

#include <algorithm>
#include <cmath>

#include "core/quadrature.h"
#include "core/units.h"

namespace millstudy::identify {

double student_975(double degrees_of_freedom) {
  // With t = sqrt(n) tan(a) the density is that of cos(a)^(n - 1); Newton's method on its integral.
  const double n = degrees_of_freedom;
  const core::GaussRule& rule = core::gauss_legendre(60);
  const auto power = [&](double a) { return std::pow(std::cos(a), n - 1.0); };
  const auto integral = [&](double to) {
    double sum = 0.0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      sum += 0.5 * to * rule.weights[k] * power(0.5 * to * (1.0 + rule.nodes[k]));
    }
    return sum;
  };
  // Beyond nine deviations there is less than rounding.
  const double half = integral(std::min(0.5 * core::kPi, 9.0 / std::sqrt(n)));
  double a = std::atan(1.96 / std::sqrt(n));
  for (int i = 0; i < 60; ++i) {
    const double step = (0.95 * half - integral(a)) / power(a);
    a += step;
    if (std::abs(step) <= 1e-15 * a) break;
  }
  return std::sqrt(n) * std::tan(a);
}

}  // namespace millstudy::identify
