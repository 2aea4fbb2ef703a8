// SPDX-License-Identifier: MIT
#include "dynamics/arnoldi.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace millstudy::dynamics {
namespace {

/// A fixed sequence without structure, within -1 .. 1.
Eigen::VectorXd scattered(int size) {
  Eigen::VectorXd v(size);
  std::uint64_t state = 0x9E3779B97F4A7C15ULL;
  for (double& value : v) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    value = static_cast<double>(state >> 11) * 0x1p-52 - 1.0;
  }
  return v;
}

Eigen::VectorXd start_vector(int size, const Eigen::VectorXd& guess) {
  Eigen::VectorXd v = scattered(size).normalized();
  // A share of everything stays in: what has overtaken the guess must be able to grow.
  if (guess.size() == size && guess.norm() > 0.0) v = guess.normalized() + 1e-3 * v;
  return v.normalized();
}

struct Ritz {
  std::complex<double> value;
  Eigen::VectorXcd vector;  // in the basis
};

/// The vector of a Hessenberg matrix to one of its eigenvalues, by inverse iteration.
Eigen::VectorXcd hessenberg_vector(const Eigen::MatrixXd& h, std::complex<double> value) {
  const Eigen::Index n = h.rows();
  const double scale = std::max(h.cwiseAbs().maxCoeff(), 1e-300);
  Eigen::MatrixXcd u = h.cast<std::complex<double>>();
  u.diagonal().array() -= value * (1.0 + 1e-15);
  Eigen::VectorXcd x = Eigen::VectorXcd::Ones(n);
  // LU of a Hessenberg matrix: one elimination a column, rows interchanged where that is larger.
  std::vector<std::complex<double>> factor(n, 0.0);
  std::vector<bool> swapped(n, false);
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    if (std::abs(u(k + 1, k)) > std::abs(u(k, k))) {
      u.row(k).tail(n - k).swap(u.row(k + 1).tail(n - k));
      swapped[k] = true;
    }
    if (u(k, k) == 0.0) u(k, k) = 1e-16 * scale;
    factor[k] = u(k + 1, k) / u(k, k);
    u.row(k + 1).tail(n - k) -= factor[k] * u.row(k).tail(n - k);
  }
  if (std::abs(u(n - 1, n - 1)) < 1e-16 * scale) u(n - 1, n - 1) = 1e-16 * scale;
  for (int pass = 0; pass < 3; ++pass) {
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
      if (swapped[k]) std::swap(x[k], x[k + 1]);
      x[k + 1] -= factor[k] * x[k];
    }
    u.triangularView<Eigen::Upper>().solveInPlace(x);
    x.normalize();
  }
  return x;
}

Ritz dominant_ritz(const Eigen::MatrixXd& h) {
  Eigen::RealSchur<Eigen::MatrixXd> schur;
  schur.computeFromHessenberg(h, Eigen::MatrixXd(), false);
  const Eigen::MatrixXd& t = schur.matrixT();
  Ritz best{0.0, {}};
  for (Eigen::Index i = 0; i < t.rows();) {
    std::complex<double> value = t(i, i);
    if (i + 1 < t.rows() && t(i + 1, i) != 0.0) {
      const double middle = 0.5 * (t(i, i) + t(i + 1, i + 1));
      const double half = 0.5 * (t(i, i) - t(i + 1, i + 1));
      const double square = half * half + t(i, i + 1) * t(i + 1, i);
      value = {middle, std::sqrt(std::max(0.0, -square))};
      ++i;
    }
    ++i;
    if (std::abs(value) > std::abs(best.value)) best.value = value;
  }
  best.vector = hessenberg_vector(h, best.value);
  return best;
}

/// When to look whether it has converged: a look costs as much as several vectors.
bool is_time_to_look(int steps) {
  for (int at = 8; at <= steps; at += std::max(4, at / 4 / 4 * 4)) {
    if (at == steps) return true;
  }
  return false;
}

/// The eigenvalue of larger modulus of [a b; c d], and its vector.
Ritz dominant_of_two(double a, double b, double c, double d) {
  const double middle = 0.5 * (a + d), half = 0.5 * (a - d), square = half * half + b * c;
  const double root = std::sqrt(std::abs(square));
  std::complex<double> value;
  if (square < 0.0)
    value = {middle, root};
  else
    value = middle < 0.0 ? middle - root : middle + root;
  Eigen::VectorXcd vector(2);
  vector << b, value - a;
  if (vector.norm() == 0.0) vector << value - d, c;
  if (vector.norm() == 0.0) vector << 1.0, 0.0;
  return {value, vector.normalized()};
}

/// Applies the map again and again, and looks at the plane of the last two vectors, where a
/// dominant pair ends up. Stops when it has converged or will not soon.
///
/// @param x  in: the start; out: the last vector, a start for another method
DominantEigenvalue by_powers(const LinearMap& map, double tolerance, Eigen::VectorXd& x) {
  constexpr int kSoon = 40;             // applications
  constexpr int kLook = 2, kTrend = 2;  // looks at every other, compares with two looks ago
  DominantEigenvalue result;
  Eigen::VectorXd image(map.size), second(map.size), q2(map.size);
  map.apply(x.data(), image.data());
  ++result.applications;
  std::array<double, kTrend> residuals;
  residuals.fill(1e300);
  for (int k = 0; k < 4 * kSoon; ++k) {
    const double norm = image.norm();
    if (!(norm < kLargestGrowth) || norm < 1.0 / kLargestGrowth) return result;
    map.apply(image.data(), second.data());
    ++result.applications;
    if (k % kLook == kLook - 1) {
      // On q1 = x and q2, the part of its image across it.
      const double h11 = x.dot(image);
      q2 = image - h11 * x;
      const double h21 = q2.norm();
      const double along = x.dot(second), across = q2.dot(second);
      const double h12 = h21 > 0.0 ? (along - h11 * h11) / h21 : 0.0;
      const double h22 = h21 > 0.0 ? (across / h21 - h11 * h21) / h21 : 0.0;
      const Ritz ritz = dominant_of_two(h11, h12, h21, h22);
      const double modulus = std::abs(ritz.value);
      // What of the image of q2 is in neither: M q2 = (second - h11 image) / h21.
      double out = 0.0;
      if (h21 > 0.0) {
        out = (second - h11 * image - h21 * (h12 * x + h22 / h21 * q2)).norm() / h21;
      }
      result.residual = out * std::abs(ritz.vector[1]) / modulus;
      result.value = ritz.value;
      const bool done = h21 <= 1e-15 * std::abs(h11) || result.residual <= tolerance;
      if (done) {
        result.converged = true;
        result.vector = x * ritz.vector[0];
        if (h21 > 0.0) result.vector += q2 * (ritz.vector[1] / h21);
        return result;
      }
      const double before = residuals[k / kLook % kTrend];
      residuals[k / kLook % kTrend] = result.residual;
      if (k >= kLook * (kTrend + 1)) {
        const double rate = std::log(result.residual / before) / (kLook * kTrend);
        const double left = std::log(tolerance / result.residual) / rate;
        if (!(rate < 0.0 && left < kSoon)) break;
      }
    }
    x = image * (1.0 / norm);
    image = second * (1.0 / norm);
  }
  return result;
}

}  // namespace

DominantEigenvalue dominant_eigenvalue(const LinearMap& map, const ArnoldiSettings& settings) {
  const int n = map.size;
  Eigen::VectorXd start = start_vector(n, settings.start);
  if (n > 2) {
    DominantEigenvalue quick = by_powers(map, settings.tolerance, start);
    if (quick.converged) return quick;
  }
  const int most = std::min(n, settings.largest_basis);
  DominantEigenvalue result;
  Eigen::MatrixXd basis(n, std::min(n, 32) + 1);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(most + 1, most);
  basis.col(0) = start;
  for (int restart = 0; restart <= settings.restarts; ++restart) {
    h.setZero();
    for (int k = 0; k < most; ++k) {
      if (k + 2 > basis.cols()) {
        basis.conservativeResize(Eigen::NoChange,
                                 std::min<Eigen::Index>(2 * basis.cols(), most + 1));
      }
      auto next = basis.col(k + 1);
      map.apply(basis.col(k).data(), next.data());
      ++result.applications;
      if (!(next.cwiseAbs().maxCoeff() < kLargestGrowth)) {  // overflow included
        result.value = kLargestGrowth;
        result.vector = basis.col(k);
        result.converged = true;
        return result;
      }
      const auto so_far = basis.leftCols(k + 1);
      Eigen::VectorXd along = so_far.transpose() * next;
      next.noalias() -= so_far * along;
      const Eigen::VectorXd again = so_far.transpose() * next;
      next.noalias() -= so_far * again;
      h.col(k).head(k + 1) = along + again;
      const double left = next.norm();
      h(k + 1, k) = left;
      const bool whole = left <= 1e-15 * h.col(k).head(k + 1).norm();  // the space is invariant
      if (!whole) next /= left;
      const int steps = k + 1;
      if (!whole && steps < most && !is_time_to_look(steps)) continue;
      const Ritz ritz = dominant_ritz(h.topLeftCorner(steps, steps));
      const double size = std::abs(ritz.value);
      result.value = ritz.value;
      result.residual = size > 0.0 ? left * std::abs(ritz.vector[steps - 1]) / size : 0.0;
      result.converged = whole || steps == n || result.residual <= settings.tolerance;
      if (result.converged || steps == most) {
        result.vector = basis.leftCols(steps) * ritz.vector;
        break;
      }
    }
    if (result.converged) break;
    basis.col(0) = (result.vector.real() + result.vector.imag()).normalized();
  }
  return result;
}

}  // namespace millstudy::dynamics
