// SPDX-License-Identifier: MIT
// The key table; [cutter] and [coefficients] have files of their own. A line here is all it takes
// to give a study a new key.
#include "study/key_table.h"

namespace millstudy::study {

using namespace table;

// clang-format off

std::span<const Key> general_keys() {
  static const std::vector<Key> keys = {
      {"schema_version", kInteger, "", {1.0, 1.0}, Required{}, "version of the study file: 1"},
      {"study.name", kText, "", {}, Required{}, "names the result file, NAME.h5: letters, digits, _ - + and dots"},
      {"study.kind", kText, "", {}, Required{}, "what is computed: path, force, path_force, stability or finish"},
      {"study.point_time_limit_s", kNumber, "s", up_to(1e9), Optional{}, "a point that takes longer fails; without, none does"},
      {"study.description", kText, "", {}, "", "the question, in a sentence"},
  };
  return keys;
}

std::span<const Key> output_keys() {
  static const std::vector<Key> keys = {
      {"output.traces", kFlag, "", {}, Optional{}, "keep time histories (float32)"},
      {"output.harmonics", kInteger, "", {0.0, 100.0}, 0.0,
       "harmonics: amplitudes of forces and torque at 1 .. this many times the tooth passing frequency"},
      {"output.per_flute", kFlag, "", {}, Optional{},
       "chip thickness and load share of every flute"},
  };
  return keys;
}

std::span<const Key> path_keys() {
  static const std::vector<Key> keys = {
      {"path.curve_file", kFile, "", {}, Required{},
       "curve: a TOML file, relative to the study file; or an inline table [path.curve]",
       MILLSTUDY_SETS(path.curve)},
      {"path.interpolation_period_s", kNumber, "s", up_to(10.0), Required{},
       "interpolation period: T of the controller", MILLSTUDY_SETS(path.interpolation.period)},
      {"path.method", kChoice, "", {}, "newton",
       "interpolator: how the next parameter is found", MILLSTUDY_SETS(path.interpolation.method),
       {"uniform_parameter", "taylor1", "taylor2", "predictor_corrector", "arc_length_table", "newton"}},
      {"path.max_iterations", kInteger, "", {1.0, 100.0}, 2.0,
       "updates N per step: at most (newton, predictor_corrector)",
       MILLSTUDY_SETS(path.interpolation.max_iterations)},
      {"path.tolerance_percent", kNumber, "%", {0.0, 100.0, false, true}, 0.0,
       "tolerance: feed fluctuation at which the updates of a step end",
       MILLSTUDY_SETS(path.interpolation.tolerance)},
      {"path.steps", kInteger, "", {1.0, 1e7}, 1000.0,
       "parameter steps: of uniform_parameter", MILLSTUDY_SETS(path.interpolation.steps)},
      {"path.table_size", kInteger, "", {2.0, 1e6}, 1000.0,
       "table size: intervals of arc_length_table", MILLSTUDY_SETS(path.interpolation.table_size)},
  };
  return keys;
}

std::span<const Key> cut_keys() {
  static const std::vector<Key> keys = {
      {"cut.feed_rate_mm_per_min", kNumber, "mm/min", up_to(1e6), Optional{},
       "feed rate; or feed_per_tooth_mm", MILLSTUDY_SETS(cut.feed_rate)},
      {"cut.feed_per_tooth_mm", kNumber, "mm", up_to(100.0), Optional{},
       "feed per tooth; or feed_rate_mm_per_min", MILLSTUDY_SETS(cut.feed_per_tooth)},
      {"cut.spindle_speed_rpm", kNumber, "rpm", up_to(1e6), Required{},
       "spindle speed", MILLSTUDY_SETS(cut.spindle_speed)},
      {"cut.axial_depth_mm", kNumber, "mm", up_to(1000.0), Required{},
       "axial depth of cut", MILLSTUDY_SETS(cut.axial_depth)},
      {"cut.milling", kChoice, "", {}, Optional{},
       "engagement; or entry_deg and exit_deg", MILLSTUDY_SETS(cut.milling), {"slot", "up", "down"}},
      {"cut.radial_depth_mm", kNumber, "mm", up_to(1000.0), Optional{},
       "radial depth of cut; for up and down milling", MILLSTUDY_SETS(cut.radial_depth)},
      {"cut.entry_deg", kNumber, "deg", {0.0, 180.0, false, true}, Optional{},
       "entry angle: immersion at which teeth enter, from +y towards +x", MILLSTUDY_SETS(cut.entry_angle)},
      {"cut.exit_deg", kNumber, "deg", up_to(180.0), Optional{},
       "exit angle: immersion at which teeth leave", MILLSTUDY_SETS(cut.exit_angle)},
  };
  return keys;
}

std::span<const Key> stock_keys() {
  static const std::vector<Key> keys = {
      {"cut.stock", kChoice, "", {}, "endless",
       "where the path begins or ends at the side of the workpiece", MILLSTUDY_SETS(cut.stock),
       {"endless", "entry", "exit", "both"}},
  };
  return keys;
}

std::span<const Key> numerics_keys() {
  static const std::vector<Key> keys = {
      {"numerics.rule", kChoice, "", {}, "exact",
       "edge rule: exact, or the papers' equal-height discs", MILLSTUDY_SETS(edge_rule.rule),
       {"exact", "discs"}},
      {"numerics.discs", kInteger, "", {1.0, 1e6}, 200.0,
       "discs: over the axial depth, for rule discs", MILLSTUDY_SETS(edge_rule.discs)},
      {"numerics.angular_steps", kInteger, "", {4.0, 1e6}, 360.0,
       "angular steps: force samples per spindle revolution", MILLSTUDY_SETS(angular_steps)},
  };
  return keys;
}

// clang-format on

std::span<const Key> path_feed_keys() {
  static const std::vector<Key> keys = [] {
    Key feed_rate = cut_keys().front();
    feed_rate.fallback = Required{};
    feed_rate.help = "feed rate";
    return std::vector<Key>{feed_rate};
  }();
  return keys;
}

}  // namespace millstudy::study
