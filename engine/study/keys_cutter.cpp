// SPDX-License-Identifier: MIT
// The key table of [cutter].
#include "study/key_table.h"

namespace millstudy::study {
namespace {

using namespace table;

constexpr std::string_view kShape = "cutter.shape";

}  // namespace

// clang-format off

std::span<const Key> cutter_keys() {
  static const std::vector<Key> keys = {
      {"cutter.cutter_file", kFile, "", {}, Optional{},
       "cutter: keys of this section from a TOML file, where they are not given here"},
      {kShape, kChoice, "", {}, Required{},
       "envelope of the cutter", MILLSTUDY_SETS(cutter.shape),
       {"flat", "ball", "bull_nose", "taper", "general", "profile"}},
      {"cutter.diameter_mm", kNumber, "mm", {1e-3, 1000.0}, Required{},
       "diameter; of taper and general where the taper meets the height of the tip",
       MILLSTUDY_SETS(cutter.diameter)},
      {"cutter.flutes", kInteger, "", {1.0, 100.0}, Required{},
       "number of flutes", MILLSTUDY_SETS(cutter.flutes)},
      {"cutter.helix_deg", kNumberOrNumbers, "deg", within(80.0), Required{},
       "helix angle; negative is left-hand; a list has one for each flute",
       [](Case& c) -> Field { return NumberOrNumbers{&c.cutter.helix_angle, &c.cutter.helix_angles}; }},
      {"cutter.corner_radius_mm", kNumber, "mm", {0.0, 1000.0}, RequiredFor{kShape, "bull_nose"},
       "corner radius", MILLSTUDY_SETS(cutter.corner_radius), {},
       {kShape, {"bull_nose", "taper", "general"}}},
      {"cutter.taper_deg", kNumber, "deg", {-45.0, 80.0}, RequiredFor{kShape, "taper"},
       "taper: angle between side and axis; negative is a dovetail", MILLSTUDY_SETS(cutter.taper_angle), {},
       {kShape, {"ball", "taper", "general"}}},
      {"cutter.tip_angle_deg", kNumber, "deg", {0.0, 80.0}, 0.0,
       "tip angle: of the cone at the tip, from the plane", MILLSTUDY_SETS(cutter.tip_angle), {},
       {kShape, {"general"}}},
      {"cutter.corner_centre_radius_mm", kNumber, "mm", within(1000.0), Optional{},
       "corner centre: distance from the axis; where it is not given the corner is tangent to tip and side",
       MILLSTUDY_SETS(cutter.corner_centre_radius), {}, {kShape, {"general"}}},
      {"cutter.corner_centre_height_mm", kNumber, "mm", within(1000.0), Optional{},
       "height of the corner centre: above the tip", MILLSTUDY_SETS(cutter.corner_centre_height), {},
       {kShape, {"general"}}},
      {"cutter.profile_file", kFile, "", {}, RequiredFor{kShape, "profile"},
       "profile: a TOML file with points_mm = [[z, r], ...]", MILLSTUDY_SETS(cutter.profile), {},
       {kShape, {"profile"}}},
      {"cutter.flute_length_mm", kNumber, "mm", up_to(1000.0), Optional{},
       "flute length: no cut is deeper", MILLSTUDY_SETS(cutter.flute_length)},
      {"cutter.stick_out_mm", kNumber, "mm", up_to(10000.0), Optional{},
       "stick-out: from the tip to the holder; adds bending_moment_max", MILLSTUDY_SETS(stick_out)},
      {"cutter.lead", kChoice, "", {}, "constant_lead",
       "lead: what stays the same along a taper", MILLSTUDY_SETS(cutter.lead),
       {"constant_lead", "constant_helix"}},
      {"cutter.edge_measure", kChoice, "", {}, "automatic",
       "edge measure: what edge coefficients are per unit of; automatic is chip_width on a cylinder, edge_length elsewhere",
       MILLSTUDY_SETS(cutter.edge_measure), {"automatic", "chip_width", "edge_length"}},
      {"cutter.pitch_deg", kNumbers, "deg", {0.0, 360.0, true, false}, Optional{},
       "pitch: from each flute to the next, sum 360; equal where it is not given",
       [](Case& c) -> Field { return PartsOfTurn{&c.cutter.pitch_angles}; }},
      {"cutter.runout_offset_mm", kNumber, "mm", {0.0, 1000.0}, 0.0,
       "runout: of the cutter's axis at the tip", MILLSTUDY_SETS(cutter.runout.offset)},
      {"cutter.runout_angle_deg", kNumber, "deg", within(360.0), 0.0,
       "runout angle: from the tip of the first flute towards the second",
       MILLSTUDY_SETS(cutter.runout.angle)},
      {"cutter.runout_tilt_deg", kNumber, "deg", {0.0, 10.0}, 0.0,
       "runout tilt: of the cutter's axis against the spindle's", MILLSTUDY_SETS(cutter.runout.tilt)},
      {"cutter.runout_tilt_angle_deg", kNumber, "deg", within(360.0), 0.0,
       "direction of the tilt: where the cutter's axis leans to, going up from the tip",
       MILLSTUDY_SETS(cutter.runout.tilt_angle)},
  };
  return keys;
}

// clang-format on

}  // namespace millstudy::study
