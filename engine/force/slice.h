// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace millstudy::force {

/// Rows x, y, z [N] in feed axes, on the tool, and torque [N mm].
inline constexpr int kRows = 4;
/// Columns tangential, radial, axial.
inline constexpr int kColumns = 3;

template <class T>
using Matrix43 = std::array<std::array<T, kColumns>, kRows>;

/// (F4): turns a force in edge axes (tangential, radial, axial) into feed axes and torque.
///
/// The first three rows are orthogonal: the misprints of the paper's (14) are put right.
///
/// @param sin_phi, cos_phi      of the immersion angle; T is double, or a derivative type in a fit
/// @param sin_kappa, cos_kappa  of the axial immersion angle
/// @param radius                r of the slice [mm]
/// @return rows x, y, z, torque; columns t, r, a; shape (4, 3)
template <class T>
Matrix43<T> edge_axes(const T& sin_phi, const T& cos_phi, const T& sin_kappa, const T& cos_kappa,
                      const T& radius) {
  const T zero{0.0};
  return {{{-cos_phi, -sin_phi * sin_kappa, -sin_phi * cos_kappa},
           {sin_phi, -cos_phi * sin_kappa, -cos_phi * cos_kappa},
           {zero, cos_kappa, -sin_kappa},
           {radius, zero, zero}}};
}

/// Force as a linear function of the loads: F = feed_per_tooth chip K_c + edge K_e, (F3).
template <class T>
struct Basis {
  Matrix43<T> chip{};  ///< times feed_per_tooth [mm] times (Ktc, Krc, Kac) [N/mm2]; unit mm
  Matrix43<T> edge{};  ///< times (Kte, Kre, Kae) [N/mm]; unit mm; torque rows mm2
};

/// Adds one slice of a cutting edge (F3): chip area h db = feed_per_tooth sin(phi) dz, from (F1),
/// edge length dS.
///
/// @param axes   edge_axes() of the slice
/// @param chip   chip area per feed, sin(phi) dz [mm]
/// @param edge   edge length dS [mm]
template <class T>
void add_slice(Basis<T>& basis, const Matrix43<T>& axes, const T& chip, const T& edge) {
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      basis.chip[row][column] += chip * axes[row][column];
      basis.edge[row][column] += edge * axes[row][column];
    }
  }
}

/// (F3): the force of a basis under loads(), rows x, y, z [N], torque [N mm]; shape (4).
template <class T>
std::array<T, kRows> apply(const Basis<T>& basis, const std::array<T, 2 * kColumns>& load) {
  std::array<T, kRows> force{};
  for (int column = 0; column < kColumns; ++column) {
    for (int row = 0; row < kRows; ++row) {
      force[row] += basis.chip[row][column] * load[column];
      force[row] += basis.edge[row][column] * load[kColumns + column];
    }
  }
  return force;
}

}  // namespace millstudy::force
