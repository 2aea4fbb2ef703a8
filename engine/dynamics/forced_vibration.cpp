// SPDX-License-Identifier: MIT
#include "dynamics/forced_vibration.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "dynamics/collocation.h"

namespace millstudy::dynamics {
namespace {

constexpr int kMostVectors = 200;
constexpr int kCompared = 64;  // places in a period

/// (D31): x = map(x) + constant by GMRES (Y. Saad, M.H. Schultz, SIAM J. Sci. Stat. Comput. 7
/// (1986) 856-869); the map is compact, some tens of vectors are enough.
Eigen::VectorXd fixed_point(const LinearMap& map, const Eigen::VectorXd& constant) {
  const double size = constant.norm();
  if (size == 0.0) return constant;
  const int most = std::min(map.size, kMostVectors);
  Eigen::MatrixXd basis(map.size, most + 1);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(most + 1, most);
  basis.col(0) = constant / size;
  Eigen::VectorXd image(map.size);
  for (int k = 0; k < most; ++k) {
    map.apply(basis.col(k).data(), image.data());
    Eigen::VectorXd next = basis.col(k) - image;
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd along = basis.leftCols(k + 1).transpose() * next;
      next -= basis.leftCols(k + 1) * along;
      h.col(k).head(k + 1) += along;
    }
    h(k + 1, k) = next.norm();
    const int steps = k + 1;
    const bool whole = h(k + 1, k) <= 1e-15 * h.col(k).norm();
    if (!whole) basis.col(k + 1) = next / h(k + 1, k);
    if (!whole && steps < most && steps % 8 != 0) continue;
    const Eigen::VectorXd target = size * Eigen::VectorXd::Unit(steps + 1, 0);
    const auto part = h.topLeftCorner(steps + 1, steps);
    const Eigen::VectorXd y = part.householderQr().solve(target);
    const double residual = (part * y - target).norm();
    if (whole || residual <= 1e-14 * size || steps == most) {
      if (!(residual <= 1e-9 * size)) break;
      return basis.leftCols(steps) * y;
    }
  }
  throw core::CaseError("the forced vibration did not converge");
}

PeriodicMotion motion_of(const CollocationMap& map,
                         const std::function<Eigen::Vector2d(double t)>& force) {
  const std::vector<double> forces = map.force_at_nodes(force);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(map.size());
  Eigen::VectorXd constant(map.size());
  map.apply(rest.data(), constant.data(), forces);
  const Eigen::VectorXd start = fixed_point(map.map(), constant);
  return map.motion(start.data(), forces);
}

}  // namespace

PeriodicMotion forced_vibration(const DelaySystem& system,
                                const std::function<Eigen::Vector2d(double t)>& force,
                                double tolerance) {
  if (!(tolerance >= 1e-12 && tolerance <= 0.1)) {
    throw core::InputError(fmt::format("tolerance = {} must be between 1e-12 and 0.1", tolerance));
  }
  constexpr Collocation kLadder[] = {{6, 4.0},  {8, 4.0},  {12, 4.0}, {16, 4.0},
                                     {16, 2.0}, {16, 1.0}, {16, 0.5}, {16, 0.25}};
  PeriodicMotion before(system.period);
  for (const Collocation& settings : kLadder) {
    PeriodicMotion now = motion_of(CollocationMap(system, settings), force);
    double off = 0.0;
    for (int i = 0; i < kCompared; ++i) {
      const double t = system.period * (i + 0.5) / kCompared;
      off = std::max(off, (now.at(t) - before.at(t)).norm());
    }
    const double largest = now.largest();
    if (!std::isfinite(largest)) break;
    if (off <= std::max(0.1 * tolerance, 1e-13) * largest) return now;
    before = std::move(now);
  }
  throw core::CaseError("the forced vibration did not reach the tolerance");
}

}  // namespace millstudy::dynamics
