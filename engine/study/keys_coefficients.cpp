// SPDX-License-Identifier: MIT
// The key table of [coefficients].
#include "study/key_table.h"

namespace millstudy::study {
namespace {

using namespace table;

constexpr std::string_view kModel = "coefficients.model";
constexpr RequiredFor kNeeded{kModel, "constant"};    // with it, coefficients are given as numbers
constexpr RequiredFor kTested{kModel, "orthogonal"};  // cutting tests give these
constexpr Range kCoefficient = within(1e6);
constexpr Range kExponent{0.0, 1.0, false, true};
constexpr Range kFactor = within(1000.0);
constexpr Count kPolynomial{1, 4};
constexpr Count kLeastAndMost{2, 2};

const OnlyFor& constant() {
  static const OnlyFor only{kModel, {"constant"}};
  return only;
}
const OnlyFor& orthogonal() {
  static const OnlyFor only{kModel, {"orthogonal"}};
  return only;
}

}  // namespace

// clang-format off

std::span<const Key> coefficient_keys() {
  static const std::vector<Key> keys = {
      {"coefficients.coefficients_file", kFile, "", {}, Optional{},
       "coefficients: keys of this section from a TOML file, where they are not given here"},
      {kModel, kChoice, "", {}, "constant",
       "model: the chip coefficients as numbers, or from orthogonal cutting tests",
       MILLSTUDY_SETS(law.model), {"constant", "orthogonal"}},
      {"coefficients.Ktc_N_per_mm2", kNumber, "N/mm2", kCoefficient, kNeeded,
       "tangential cutting-force coefficient", MILLSTUDY_SETS(coefficients.Ktc), {}, constant()},
      {"coefficients.Krc_N_per_mm2", kNumber, "N/mm2", kCoefficient, kNeeded,
       "radial cutting-force coefficient", MILLSTUDY_SETS(coefficients.Krc), {}, constant()},
      {"coefficients.Kac_N_per_mm2", kNumber, "N/mm2", kCoefficient, kNeeded,
       "axial cutting-force coefficient", MILLSTUDY_SETS(coefficients.Kac), {}, constant()},
      {"coefficients.Kte_N_per_mm", kNumber, "N/mm", kCoefficient, Required{},
       "tangential edge-force coefficient", MILLSTUDY_SETS(coefficients.Kte)},
      {"coefficients.Kre_N_per_mm", kNumber, "N/mm", kCoefficient, Required{},
       "radial edge-force coefficient", MILLSTUDY_SETS(coefficients.Kre)},
      {"coefficients.Kae_N_per_mm", kNumber, "N/mm", kCoefficient, Required{},
       "axial edge-force coefficient", MILLSTUDY_SETS(coefficients.Kae)},
      {"coefficients.cutting_scale", kNumber, "", {0.0, 1000.0}, 1.0,
       "wear factor of the chip: times Ktc, Krc and Kac", MILLSTUDY_SETS(law.cutting_scale)},
      {"coefficients.edge_scale", kNumber, "", {0.0, 1000.0}, 1.0,
       "wear factor of the edge: times Kte, Kre and Kae", MILLSTUDY_SETS(law.edge_scale)},
      {"coefficients.process_damping_N_per_mm", kNumber, "N/mm", {0.0, 1e6}, 0.0,
       "process damping: force of the flank on a vibrating edge, times width and radial over cutting speed; for stability and finish", MILLSTUDY_SETS(law.process_damping)},
      {"coefficients.Ktc_exponent", kNumber, "", kExponent, 0.0,
       "tangential size exponent: m of K (h / reference)^-m", MILLSTUDY_SETS(law.size_exponent[0]), {}, constant()},
      {"coefficients.Krc_exponent", kNumber, "", kExponent, 0.0,
       "radial size exponent: m of K (h / reference)^-m", MILLSTUDY_SETS(law.size_exponent[1]), {}, constant()},
      {"coefficients.Kac_exponent", kNumber, "", kExponent, 0.0,
       "axial size exponent: m of K (h / reference)^-m", MILLSTUDY_SETS(law.size_exponent[2]), {}, constant()},
      {"coefficients.reference_chip_thickness_mm", kNumber, "mm", up_to(100.0), Optional{},
       "reference chip thickness: at which the size effect leaves the coefficients as they are",
       MILLSTUDY_SETS(law.reference_chip_thickness), {}, constant()},
      {"coefficients.heights_mm", kNumbers, "mm", {0.0, 1000.0}, Optional{},
       "heights: above the tip, ascending, of the tables", MILLSTUDY_SETS(law.height.heights)},
      {"coefficients.Ktc_table", kNumbers, "", kFactor, Optional{},
       "factors of Ktc: at the heights", MILLSTUDY_SETS(law.height.table[0])},
      {"coefficients.Krc_table", kNumbers, "", kFactor, Optional{},
       "factors of Krc: at the heights", MILLSTUDY_SETS(law.height.table[1])},
      {"coefficients.Kac_table", kNumbers, "", kFactor, Optional{},
       "factors of Kac: at the heights", MILLSTUDY_SETS(law.height.table[2])},
      {"coefficients.Kte_table", kNumbers, "", kFactor, Optional{},
       "factors of Kte: at the heights", MILLSTUDY_SETS(law.height.table[3])},
      {"coefficients.Kre_table", kNumbers, "", kFactor, Optional{},
       "factors of Kre: at the heights", MILLSTUDY_SETS(law.height.table[4])},
      {"coefficients.Kae_table", kNumbers, "", kFactor, Optional{},
       "factors of Kae: at the heights", MILLSTUDY_SETS(law.height.table[5])},
      {"coefficients.Ktc_polynomial", kNumbers, "", kCoefficient, Optional{},
       "polynomial of Ktc: c1, c2, ... of K (1 + c1 z + c2 z^2 + ...), z in mm",
       MILLSTUDY_SETS(law.height.polynomial[0]), {}, {}, kPolynomial},
      {"coefficients.Krc_polynomial", kNumbers, "", kCoefficient, Optional{},
       "polynomial of Krc: c1, c2, ... of K (1 + c1 z + c2 z^2 + ...), z in mm",
       MILLSTUDY_SETS(law.height.polynomial[1]), {}, {}, kPolynomial},
      {"coefficients.Kac_polynomial", kNumbers, "", kCoefficient, Optional{},
       "polynomial of Kac: c1, c2, ... of K (1 + c1 z + c2 z^2 + ...), z in mm",
       MILLSTUDY_SETS(law.height.polynomial[2]), {}, {}, kPolynomial},
      {"coefficients.Kte_polynomial", kNumbers, "", kCoefficient, Optional{},
       "polynomial of Kte: c1, c2, ... of K (1 + c1 z + c2 z^2 + ...), z in mm",
       MILLSTUDY_SETS(law.height.polynomial[3]), {}, {}, kPolynomial},
      {"coefficients.Kre_polynomial", kNumbers, "", kCoefficient, Optional{},
       "polynomial of Kre: c1, c2, ... of K (1 + c1 z + c2 z^2 + ...), z in mm",
       MILLSTUDY_SETS(law.height.polynomial[4]), {}, {}, kPolynomial},
      {"coefficients.Kae_polynomial", kNumbers, "", kCoefficient, Optional{},
       "polynomial of Kae: c1, c2, ... of K (1 + c1 z + c2 z^2 + ...), z in mm",
       MILLSTUDY_SETS(law.height.polynomial[5]), {}, {}, kPolynomial},
      {"coefficients.shear_stress_N_per_mm2", kNumber, "N/mm2", up_to(1e6), kTested,
       "shear stress", MILLSTUDY_SETS(law.orthogonal.shear_stress.constant), {}, orthogonal()},
      {"coefficients.shear_angle_deg", kNumber, "deg", {1.0, 80.0}, kTested,
       "shear angle", MILLSTUDY_SETS(law.orthogonal.shear_angle.constant), {}, orthogonal()},
      {"coefficients.friction_angle_deg", kNumber, "deg", {0.0, 80.0}, kTested,
       "friction angle", MILLSTUDY_SETS(law.orthogonal.friction_angle.constant), {}, orthogonal()},
      {"coefficients.rake_deg", kNumber, "deg", within(60.0), kTested,
       "normal rake angle", MILLSTUDY_SETS(law.orthogonal.rake_angle), {}, orthogonal()},
      {"coefficients.shear_stress_per_rake_N_per_mm2_per_deg", kNumber, "N/mm2/deg", within(1e6), 0.0,
       "rise of the shear stress with rake", MILLSTUDY_SETS(law.orthogonal.shear_stress.per_rake), {}, orthogonal()},
      {"coefficients.shear_stress_per_chip_N_per_mm3", kNumber, "N/mm3", within(1e6), 0.0,
       "rise of the shear stress with chip thickness", MILLSTUDY_SETS(law.orthogonal.shear_stress.per_chip), {}, orthogonal()},
      {"coefficients.shear_angle_per_rake", kNumber, "", within(100.0), 0.0,
       "rise of the shear angle with rake: deg per deg", MILLSTUDY_SETS(law.orthogonal.shear_angle.per_rake), {}, orthogonal()},
      {"coefficients.shear_angle_per_chip_deg_per_mm", kNumber, "deg/mm", within(1e4), 0.0,
       "rise of the shear angle with chip thickness", MILLSTUDY_SETS(law.orthogonal.shear_angle.per_chip), {}, orthogonal()},
      {"coefficients.friction_angle_per_rake", kNumber, "", within(100.0), 0.0,
       "rise of the friction angle with rake: deg per deg", MILLSTUDY_SETS(law.orthogonal.friction_angle.per_rake), {}, orthogonal()},
      {"coefficients.friction_angle_per_chip_deg_per_mm", kNumber, "deg/mm", within(1e4), 0.0,
       "rise of the friction angle with chip thickness", MILLSTUDY_SETS(law.orthogonal.friction_angle.per_chip), {}, orthogonal()},
      {"coefficients.valid_feed_per_tooth_mm", kNumbers, "mm", {0.0, 100.0}, Optional{},
       "feed per tooth for which the coefficients hold: from, to; outside there is a warning",
       MILLSTUDY_SETS(valid.feed_per_tooth), {}, {}, kLeastAndMost},
      {"coefficients.valid_cutting_speed_m_per_min", kNumbers, "m/min", {0.0, 1e6}, Optional{},
       "cutting speed for which the coefficients hold: from, to; outside there is a warning",
       MILLSTUDY_SETS(valid.cutting_speed), {}, {}, kLeastAndMost},
      {"coefficients.valid_axial_depth_mm", kNumbers, "mm", {0.0, 1000.0}, Optional{},
       "axial depth for which the coefficients hold: from, to; outside there is a warning",
       MILLSTUDY_SETS(valid.axial_depth), {}, {}, kLeastAndMost},
  };
  return keys;
}

// clang-format on

}  // namespace millstudy::study
