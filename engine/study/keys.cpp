// SPDX-License-Identifier: MIT
// The key table. A line here is all it takes to give a study a new key.
#include "study/key.h"

namespace millstudy::study {
namespace {

constexpr auto kNumber = KeyType::number;
constexpr auto kInteger = KeyType::integer;
constexpr auto kChoice = KeyType::choice;

/// From above 0.
constexpr Range up_to(double high) {
  return {0.0, high, true, false};
}

constexpr Range kCoefficient{-1e6, 1e6};

}  // namespace

std::span<const Key> general_keys() {
  static const std::vector<Key> keys = {
      {"schema_version", kInteger, "", {1.0, 1.0}, Required{}, "version of the study file"},
      {"study.name", KeyType::text, "", {}, Required{}, "names the result file: <name>.h5"},
      {"study.kind", KeyType::text, "", {}, Required{}, "what is computed"},
      {"study.description", KeyType::text, "", {}, "", "the question, in a sentence"},
      {"output.traces", KeyType::flag, "", {}, Optional{}, "keep time histories (float32)"},
  };
  return keys;
}

std::span<const Key> path_keys() {
  static const std::vector<Key> keys = {
      {"path.curve_file",
       KeyType::file,
       "",
       {},
       Required{},
       "curve as a TOML file, relative to the study file; or an inline table [path.curve]",
       [](Case& c) -> Field { return &c.path.curve; }},
      {"path.interpolation_period_s", kNumber, "s", up_to(10.0), Required{},
       "interpolation period T of the controller",
       [](Case& c) -> Field { return &c.path.interpolation.period; }},
      {"path.method",
       kChoice,
       "",
       {},
       "newton",
       "how the next parameter is found",
       [](Case& c) -> Field { return &c.path.interpolation.method; },
       {"uniform_parameter", "taylor1", "taylor2", "predictor_corrector", "arc_length_table",
        "newton"}},
      {"path.max_iterations",
       kInteger,
       "",
       {1.0, 100.0},
       2.0,
       "most updates N per step (newton, predictor_corrector)",
       [](Case& c) -> Field { return &c.path.interpolation.max_iterations; }},
      {"path.tolerance_percent",
       kNumber,
       "%",
       {0.0, 100.0},
       0.0,
       "feed fluctuation at which the updates of a step end",
       [](Case& c) -> Field { return &c.path.interpolation.tolerance; }},
      {"path.steps",
       kInteger,
       "",
       {1.0, 1e7},
       1000.0,
       "parameter steps (uniform_parameter)",
       [](Case& c) -> Field { return &c.path.interpolation.steps; }},
      {"path.table_size",
       kInteger,
       "",
       {2.0, 1e6},
       1000.0,
       "entries of the table (arc_length_table)",
       [](Case& c) -> Field { return &c.path.interpolation.table_size; }},
  };
  return keys;
}

std::span<const Key> cutter_keys() {
  static const std::vector<Key> keys = {
      {"cutter.cutter_file",
       KeyType::file,
       "",
       {},
       Optional{},
       "keys of this section from a TOML file, where they are not given here"},
      {"cutter.shape",
       kChoice,
       "",
       {},
       Required{},
       "envelope of the cutter",
       [](Case& c) -> Field { return &c.cutter.shape; },
       {"flat", "ball"}},
      {"cutter.diameter_mm", kNumber, "mm", up_to(1000.0), Required{}, "diameter",
       [](Case& c) -> Field { return &c.cutter.diameter; }},
      {"cutter.flutes",
       kInteger,
       "",
       {1.0, 100.0},
       Required{},
       "number of flutes",
       [](Case& c) -> Field { return &c.cutter.flutes; }},
      {"cutter.helix_deg",
       kNumber,
       "deg",
       {-80.0, 80.0},
       Required{},
       "helix angle; negative is left-hand",
       [](Case& c) -> Field { return &c.cutter.helix_angle; }},
  };
  return keys;
}

std::span<const Key> coefficient_keys() {
  static const std::vector<Key> keys = {
      {"coefficients.coefficients_file",
       KeyType::file,
       "",
       {},
       Optional{},
       "keys of this section from a TOML file, where they are not given here"},
      {"coefficients.Ktc_N_per_mm2", kNumber, "N/mm2", kCoefficient, Required{},
       "tangential cutting-force coefficient",
       [](Case& c) -> Field { return &c.coefficients.Ktc; }},
      {"coefficients.Krc_N_per_mm2", kNumber, "N/mm2", kCoefficient, Required{},
       "radial cutting-force coefficient", [](Case& c) -> Field { return &c.coefficients.Krc; }},
      {"coefficients.Kac_N_per_mm2", kNumber, "N/mm2", kCoefficient, Required{},
       "axial cutting-force coefficient", [](Case& c) -> Field { return &c.coefficients.Kac; }},
      {"coefficients.Kte_N_per_mm", kNumber, "N/mm", kCoefficient, Required{},
       "tangential edge-force coefficient", [](Case& c) -> Field { return &c.coefficients.Kte; }},
      {"coefficients.Kre_N_per_mm", kNumber, "N/mm", kCoefficient, Required{},
       "radial edge-force coefficient", [](Case& c) -> Field { return &c.coefficients.Kre; }},
      {"coefficients.Kae_N_per_mm", kNumber, "N/mm", kCoefficient, Required{},
       "axial edge-force coefficient", [](Case& c) -> Field { return &c.coefficients.Kae; }},
  };
  return keys;
}

std::span<const Key> cut_keys() {
  static const std::vector<Key> keys = {
      {"cut.feed_rate_mm_per_min", kNumber, "mm/min", up_to(1e6), Optional{},
       "feed rate; or feed_per_tooth_mm", [](Case& c) -> Field { return &c.cut.feed_rate; }},
      {"cut.feed_per_tooth_mm", kNumber, "mm", up_to(100.0), Optional{},
       "feed per tooth; or feed_rate_mm_per_min",
       [](Case& c) -> Field { return &c.cut.feed_per_tooth; }},
      {"cut.spindle_speed_rpm", kNumber, "rpm", up_to(1e6), Required{}, "spindle speed",
       [](Case& c) -> Field { return &c.cut.spindle_speed; }},
      {"cut.axial_depth_mm", kNumber, "mm", up_to(1000.0), Required{}, "axial depth of cut",
       [](Case& c) -> Field { return &c.cut.axial_depth; }},
      {"cut.milling",
       kChoice,
       "",
       {},
       Optional{},
       "engagement; or entry_deg and exit_deg",
       [](Case& c) -> Field { return &c.cut.milling; },
       {"slot", "up", "down"}},
      {"cut.radial_depth_mm", kNumber, "mm", up_to(1000.0), Optional{},
       "radial depth of cut, for up and down milling",
       [](Case& c) -> Field { return &c.cut.radial_depth; }},
      {"cut.entry_deg",
       kNumber,
       "deg",
       {0.0, 180.0, false, true},
       Optional{},
       "immersion angle at which teeth enter, from +y towards +x",
       [](Case& c) -> Field { return &c.cut.entry_angle; }},
      {"cut.exit_deg", kNumber, "deg", up_to(180.0), Optional{},
       "immersion angle at which teeth leave", [](Case& c) -> Field { return &c.cut.exit_angle; }},
  };
  return keys;
}

std::span<const Key> path_feed_keys() {
  static const std::vector<Key> keys = [] {
    Key feed_rate = cut_keys().front();
    feed_rate.fallback = Required{};
    feed_rate.help = "feed rate";
    return std::vector<Key>{feed_rate};
  }();
  return keys;
}

std::span<const Key> numerics_keys() {
  static const std::vector<Key> keys = {
      {"numerics.rule",
       kChoice,
       "",
       {},
       "exact",
       "integration along the edge: exact, or the papers' equal-height discs",
       [](Case& c) -> Field { return &c.edge_rule.rule; },
       {"exact", "discs"}},
      {"numerics.discs",
       kInteger,
       "",
       {1.0, 1e6},
       200.0,
       "discs over the axial depth (rule discs)",
       [](Case& c) -> Field { return &c.edge_rule.discs; }},
      {"numerics.angular_steps",
       kInteger,
       "",
       {4.0, 1e6},
       360.0,
       "force samples per spindle revolution",
       [](Case& c) -> Field { return &c.angular_steps; }},
  };
  return keys;
}

}  // namespace millstudy::study
