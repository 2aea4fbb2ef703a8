// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>

namespace millstudy::dynamics {

/// A linear map of vectors that is applied, never formed.
struct LinearMap {
  int size = 0;
  /// out = map(in), both of shape (size) and not overlapping.
  std::function<void(const double* in, double* out)> apply;
};

/// Stands for every eigenvalue above it.
inline constexpr double kLargestGrowth = 1e100;

struct ArnoldiSettings {
  double tolerance = 1e-11;  ///< of the residual, relative to the eigenvalue
  int largest_basis = 250;   ///< vectors, before a restart
  int restarts = 8;
  Eigen::VectorXd start = {};  ///< a guess of the eigenvector, shape (size); empty: none
};

/// An eigenvalue of largest modulus; of a pair the one with imaginary part >= 0.
struct DominantEigenvalue {
  std::complex<double> value = 0.0;
  Eigen::VectorXcd vector;  ///< of norm 1, shape (size)
  double residual = 0.0;    ///< |map(v) - value v| over |value|
  int applications = 0;     ///< of the map
  bool converged = false;
};

/// (D12): the dominant eigenvalue, by powers of the map while these converge fast, else by
/// Arnoldi's method with two passes of orthogonalisation.
///
/// The basis grows until the residual is met: the maps of delay systems are compact, their
/// eigenvalues crowd about 0, and a few dozen vectors are enough. Deterministic: the start is a
/// fixed sequence, to which the guess is added.
/// Measured against dense eigenvalues: 1e-10 of the modulus.
DominantEigenvalue dominant_eigenvalue(const LinearMap& map, const ArnoldiSettings& settings = {});

}  // namespace millstudy::dynamics
