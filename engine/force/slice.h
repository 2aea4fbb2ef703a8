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
  const T zero{};
  return {{{-cos_phi, -sin_phi * sin_kappa, -sin_phi * cos_kappa},
           {sin_phi, -cos_phi * sin_kappa, -cos_phi * cos_kappa},
           {zero, cos_kappa, -sin_kappa},
           {radius, zero, zero}}};
}

/// (F20): turns a force in edge axes into its moments about the feed axes x and y through the tip;
/// the other two rows are zero.
///
/// @param axes   edge_axes() of the slice
/// @param z      height of the slice above the tip [mm]
template <class T>
Matrix43<T> moment_axes(const Matrix43<T>& axes, const T& sin_phi, const T& cos_phi,
                        const T& radius, const T& z) {
  Matrix43<T> moments{};
  for (int column = 0; column < kColumns; ++column) {
    moments[0][column] = radius * cos_phi * axes[2][column] - z * axes[1][column];
    moments[1][column] = z * axes[0][column] - radius * sin_phi * axes[2][column];
  }
  return moments;
}

/// Force as a linear function of the loads, (F3): F = f C K_c + E K_e + f_z P K_c.
template <class T>
struct Basis {
  Matrix43<T> chip{};    ///< times feed in the plane [mm] times (Ktc, Krc, Kac) [N/mm2]; unit mm
  Matrix43<T> edge{};    ///< times (Kte, Kre, Kae) [N/mm]; unit mm; torque rows mm2
  Matrix43<T> plunge{};  ///< times feed upward [mm] times (Ktc, Krc, Kac) [N/mm2]; unit mm
};

/// One slice of a cutting edge.
template <class T>
struct Slice {
  T chip;    ///< chip area per feed in the plane, sin(phi) dz [mm]
  T edge;    ///< edge length dS [mm]
  T plunge;  ///< chip area per feed upward, -cos(kappa) db [mm]
};

/// Adds one slice of a cutting edge (F3): chip area h db with h = f . n (F1), edge length dS.
///
/// @param axes     edge_axes() of the slice
/// @param factors  of the coefficients at this slice, (F17); 1 where they are constant; shape (6)
template <class T, class Factors>
void add_slice(Basis<T>& basis, const Matrix43<T>& axes, const Slice<T>& slice,
               const Factors& factors) {
  for (int column = 0; column < kColumns; ++column) {
    const T chip = slice.chip * factors[column];
    const T edge = slice.edge * factors[kColumns + column];
    const T plunge = slice.plunge * factors[column];
    for (int row = 0; row < kRows; ++row) {
      basis.chip[row][column] += chip * axes[row][column];
      basis.edge[row][column] += edge * axes[row][column];
      basis.plunge[row][column] += plunge * axes[row][column];
    }
  }
}

/// Column 0 .. 8 of a basis: chip, edge, plunge.
template <class T>
const T& entry(const Basis<T>& basis, int row, int column) {
  const Matrix43<T>& part = column < kColumns       ? basis.chip
                            : column < 2 * kColumns ? basis.edge
                                                    : basis.plunge;
  return part[row][column % kColumns];
}

/// (F3): the force of a basis under loads(), rows x, y, z [N], torque [N mm]; shape (4).
template <class T>
std::array<T, kRows> force_of(const Basis<T>& basis, const std::array<T, 3 * kColumns>& load) {
  std::array<T, kRows> force{};
  for (int column = 0; column < 3 * kColumns; ++column) {
    for (int row = 0; row < kRows; ++row) force[row] += entry(basis, row, column) * load[column];
  }
  return force;
}

}  // namespace millstudy::force
