// SPDX-License-Identifier: MIT
#pragma once

#include "core/units.h"
#include "cutter/cutter.h"

namespace millstudy::force {

/// A range of immersion angles in which teeth are in the material, at every height.
struct Arc {
  double entry_angle = 0.0;       ///< phi_st [rad], 0 <= entry < exit
  double exit_angle = core::kPi;  ///< phi_ex [rad], entry < exit <= pi
};

/// Where the tool is in the material: the same immersion angles at every height up to the depth.
struct Engagement {
  double entry_angle = 0.0;       ///< phi_st [rad], 0 <= entry < exit
  double exit_angle = core::kPi;  ///< phi_ex [rad], entry < exit <= pi
  double axial_depth = 1.0;       ///< a [mm], > 0

  Arc arc() const { return {entry_angle, exit_angle}; }
};

/// Full slot: 0 to pi.
Engagement slot(double axial_depth);

/// Up-milling: 0 to acos(1 - ae/R).
/// @param radius        R [mm], > 0
/// @param radial_depth  ae [mm], 0 < ae <= 2 R; throws core::InputError otherwise
Engagement up_milling(double radius, double radial_depth, double axial_depth);

/// Down-milling: pi - acos(1 - ae/R) to pi. Parameters as for up_milling.
Engagement down_milling(double radius, double radial_depth, double axial_depth);

/// Throws core::InputError for angles out of the range above.
void check(const Arc& arc);

/// Throws core::InputError for what is out of range: the angles, the depth, a depth above
/// largest_axial_depth(), and flutes that cross below it.
void check(const cutter::Cutter& cutter, const Engagement& engagement);

/// The most that check() lets pass [mm]: the length of the envelope, and the depth of a thousand
/// turns of the helix.
double largest_axial_depth(const cutter::Cutter& cutter);

/// How the cutting edge is integrated.
enum class Rule {
  exact,  ///< closed form on cylinders, Gauss-Legendre elsewhere
  discs,  ///< the paper's equal-height discs, taken at their mid-heights
};

struct EdgeRule {
  Rule rule = Rule::exact;
  int discs = 200;  ///< over the axial depth, 1 .. 1e6; not used by Rule::exact
};

/// Throws core::InputError if the number of discs is out of range.
void check(const EdgeRule& edge_rule);

}  // namespace millstudy::force
