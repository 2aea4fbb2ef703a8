// SPDX-License-Identifier: MIT
#include "dynamics/gauss_collocation.h"

#include <array>
#include <cassert>
#include <cmath>

#include "core/quadrature.h"

namespace millstudy::dynamics {
namespace {

constexpr int kMostStages = 16;

GaussCollocation make(int stages) {
  const core::GaussRule& rule = core::gauss_legendre(stages);
  GaussCollocation gauss;
  gauss.nodes.resize(stages);
  gauss.weights.resize(stages);
  gauss.integral.resize(stages, stages);
  for (int i = 0; i < stages; ++i) {
    gauss.nodes[i] = 0.5 * (1.0 + rule.nodes[i]);
    gauss.weights[i] = 0.5 * rule.weights[i];
  }
  const auto lagrange = [&](int j, double x) {
    double product = 1.0;
    for (int k = 0; k < stages; ++k) {
      if (k != j) product *= (x - gauss.nodes[k]) / (gauss.nodes[j] - gauss.nodes[k]);
    }
    return product;
  };
  // The same rule on 0 .. c_i integrates polynomials of degree N - 1 exactly.
  for (int i = 0; i < stages; ++i) {
    for (int j = 0; j < stages; ++j) {
      double sum = 0.0;
      for (int k = 0; k < stages; ++k) {
        sum += gauss.weights[k] * lagrange(j, gauss.nodes[i] * gauss.nodes[k]);
      }
      gauss.integral(i, j) = gauss.nodes[i] * sum;
    }
  }
  return gauss;
}

}  // namespace

Eigen::VectorXd GaussCollocation::interpolation(double place) const {
  const Eigen::Index count = nodes.size() + 1;
  const auto at = [&](Eigen::Index k) { return k == 0 ? 0.0 : nodes[k - 1]; };
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (std::abs(place - at(k)) < 1e-9) {
      shares[k] = 1.0;
      return shares;
    }
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    shares[k] = 1.0;
    for (Eigen::Index l = 0; l < count; ++l) {
      if (l != k) shares[k] *= (place - at(l)) / (at(k) - at(l));
    }
  }
  return shares;
}

const GaussCollocation& gauss_collocation(int stages) {
  assert(2 <= stages && stages <= kMostStages);
  static const std::array<GaussCollocation, kMostStages + 1> all = [] {
    std::array<GaussCollocation, kMostStages + 1> made;
    for (int n = 2; n <= kMostStages; ++n) made[n] = make(n);
    return made;
  }();
  return all[stages];
}

}  // namespace millstudy::dynamics
