// SPDX-License-Identifier: MIT
#include "cutter/flutes.h"
#include "unit/force/random_cutters.h"

namespace millstudy::force::testing {
namespace {

std::ostream& list(std::ostream& out, const std::vector<double>& values) {
  out << "{";
  for (std::size_t i = 0; i < values.size(); ++i) out << (i ? ", " : "") << values[i];
  return out << "}";
}

void print_cutter(std::ostream& out, const cutter::Cutter& c) {
  out << "{.shape = Shape(" << static_cast<int>(c.shape) << "), .diameter = " << c.diameter
      << ", .flutes = " << c.flutes << ", .helix_angle = " << c.helix_angle
      << ", .corner_radius = " << c.corner_radius << ", .taper_angle = " << c.taper_angle
      << ", .tip_angle = " << c.tip_angle;
  if (c.corner_centre_radius) {
    out << ", .corner_centre_radius = " << *c.corner_centre_radius
        << ", .corner_centre_height = " << *c.corner_centre_height;
  }
  if (c.flute_length) out << ", .flute_length = " << *c.flute_length;
  out << ", .lead = Lead(" << static_cast<int>(c.lead) << "), .edge_measure = EdgeMeasure("
      << static_cast<int>(c.edge_measure) << ")";
  if (c.profile) {
    out << ", .profile = {";
    for (const auto& [z, r] : *c.profile) out << "{" << z << ", " << r << "}, ";
    out << "}";
  }
  list(out << ", .pitch_angles = ", c.pitch_angles);
  list(out << ", .helix_angles = ", c.helix_angles);
  out << ", .runout = {" << c.runout.offset << ", " << c.runout.angle << ", " << c.runout.tilt
      << ", " << c.runout.tilt_angle << "}}";
}

void print_variation(std::ostream& out, const Variation& v) {
  if (v.height) {
    list(out << ", heights ", v.height->heights);
    for (const auto& table : v.height->table) list(out << " table ", table);
    for (const auto& terms : v.height->polynomial) list(out << " polynomial ", terms);
  }
  out << ", exponents {" << v.size_exponent[0] << ", " << v.size_exponent[1] << ", "
      << v.size_exponent[2] << "} of " << v.reference_chip_thickness;
  if (!v.orthogonal) return;
  out << ", orthogonal rake " << v.orthogonal->rake_angle;
  for (const OrthogonalQuantity& q :
       {v.orthogonal->shear_stress, v.orthogonal->shear_angle, v.orthogonal->friction_angle}) {
    list(out << " ", {q.constant, q.per_rake, q.per_chip});
  }
}

}  // namespace

std::string name(Kind kind) {
  switch (kind) {
    case Kind::flat:
      return "flat";
    case Kind::ball:
      return "ball";
    case Kind::tapered_ball:
      return "tapered ball";
    case Kind::bull_nose:
      return "bull nose";
    case Kind::taper:
      return "taper";
    case Kind::general:
      return "general, tangent corner";
    case Kind::general_centred:
      return "general, corner centre given";
    case Kind::profile:
      return "profile";
  }
  return "";
}

std::string features(const reference::Cut& cut) {
  std::string all;
  const auto add = [&](bool has, const char* text) {
    if (has) all += (all.empty() ? "" : "+") + std::string(text);
  };
  add(cut.cutter.runout.offset != 0.0, "offset");
  add(cut.cutter.runout.tilt != 0.0, "tilt");
  add(cut.feed.slope != 0.0, "slope");
  add(cutter::has_variable_helix(cut.cutter), "helices");
  add(cut.variation.size_exponent != std::array<double, 3>{}, "size");
  add(cut.variation.orthogonal && cut.variation.with_chip(), "rates");
  return all.empty() ? "linear" : all;
}

std::ostream& operator<<(std::ostream& out, const reference::Cut& cut) {
  const auto precision = out.precision(17);
  print_cutter(out, cut.cutter);
  out << ", depth " << cut.axial_depth << ", arcs";
  for (const Arc& arc : cut.arcs) list(out << " ", {arc.entry_angle, arc.exit_angle});
  out << ", feed " << cut.feed.per_tooth << " slope " << cut.feed.slope << ", Ktc "
      << cut.coefficients.Ktc;
  print_variation(out, cut.variation);
  out.precision(precision);
  return out;
}

}  // namespace millstudy::force::testing
