// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace millstudy::force {

/// (F17): each coefficient times a factor that depends on the height of the edge point: the
/// interpolated table, times 1 + c1 z + c2 z^2 + ...
///
/// The six stand in the order of Coefficients: Ktc Krc Kac Kte Kre Kae.
struct HeightFactors {
  std::vector<double> heights;               ///< z of the tables [mm], >= 0, ascending
  std::array<std::vector<double>, 6> table;  ///< factors at the heights, constant beyond; empty: 1
  std::array<std::vector<double>, 6> polynomial;  ///< c1, c2, ... [1/mm^n], at most four; empty: 1
};

/// A quantity of orthogonal cutting, linear in rake angle and chip thickness.
struct OrthogonalQuantity {
  double constant = 0.0;
  double per_rake = 0.0;  ///< per rad
  double per_chip = 0.0;  ///< per mm
};

/// What orthogonal cutting tests measure; chip flow follows Stabler's rule.
struct OrthogonalData {
  OrthogonalQuantity shear_stress;    ///< tau_s [N/mm2]
  OrthogonalQuantity shear_angle;     ///< phi_c [rad]
  OrthogonalQuantity friction_angle;  ///< beta_a [rad]
  double rake_angle = 0.0;            ///< normal rake alpha_n [rad]
};

/// How the cutting-force coefficients vary along the edge and with the chip; constant unless said.
struct Variation {
  /// (F18): K h^-m in place of K, h in units of the reference: m of the tangential, radial and
  /// axial coefficient, 0 <= m < 1.
  std::array<double, 3> size_exponent{};
  double reference_chip_thickness = 1.0;  ///< h0 [mm], > 0
  std::shared_ptr<const HeightFactors> height = nullptr;
  /// (F19): the chip coefficients [N/mm2] by oblique transformation; what Coefficients gives for
  /// them are then factors.
  std::optional<OrthogonalData> orthogonal = std::nullopt;

  bool with_exponent() const;  ///< there is a size effect
  bool with_chip() const;    ///< a coefficient depends on chip thickness: no longer linear in feed
  bool with_height() const;  ///< a coefficient depends on the place on the edge
};

/// Throws core::InputError for what is out of the ranges above.
void check(const Variation& variation);

/// (F17): the six factors at a height; shape (6).
std::array<double, 6> height_factors(const HeightFactors& factors, double z);

/// (F19): Ktc, Krc, Kac [N/mm2] of oblique cutting from orthogonal data; shape (3).
///
/// Exact to rounding.
/// @param inclination     i, the local helix angle [rad]; its sign does not count: a left-hand
///                        cutter has the same coefficients
/// @param chip_thickness  h [mm]
/// Whatever the linear rates say, the shear stress is kept >= 0, the shear angle within 1..80 deg,
/// the friction angle within 0..80 deg, and shear angle plus normal friction less rake <= 89 deg.
std::array<double, 3> oblique_coefficients(const OrthogonalData& data, double inclination,
                                           double chip_thickness);

}  // namespace millstudy::force
