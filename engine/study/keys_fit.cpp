// SPDX-License-Identifier: MIT
// Keys of fit files: [fit], [trace] and [[record]]. [cutter] and [cut] are those of studies.
#include "study/fit_file.h"
#include "study/key_table.h"

namespace millstudy::study {
namespace {

using namespace table;

constexpr auto kChoices = KeyType::choices;
constexpr auto kTable = KeyType::table;

// clang-format off

std::span<const Key> version_keys() {
  static const std::vector<Key> keys = {
      {"schema_version", kInteger, "", {1.0, 1.0}, Required{}, "version of the fit file: 1"},
  };
  return keys;
}

std::span<const Key> method_keys() {
  static const std::vector<Key> keys = {
      {"fit.name", kText, "", {}, Required{}, "names the result file, NAME.h5: letters, digits, _ - + and dots"},
      {"fit.description", kText, "", {}, "", "what was measured, in a sentence"},
      {"fit.method", kChoice, "", {}, "instantaneous",
       "average: regression of mean forces over feed; instantaneous: every sample of every record", nullptr,
       {"average", "instantaneous"}},
      {"fit.model", kChoice, "", {}, "constant",
       "how coefficients vary: not at all, linear in height, with a power of chip thickness; auto: the one that predicts left-out records best",
       nullptr, {"constant", "per_height", "exponential", "auto"}},
      {"fit.estimate", kChoices, "", {}, "phase, spindle_speed, runout, offset",
       "what is estimated besides the coefficients, record by record; dynamometer: modes, of all records together", nullptr,
       {"phase", "spindle_speed", "runout", "offset", "drift", "phase_drift", "dynamometer"}},
      {"fit.shared", kChoices, "", {}, Optional{},
       "of these, what all records have in common", nullptr, {"spindle_speed", "runout"}},
      {"fit.axes", kChoices, "", {}, "x, y, z", "axes that are fitted", nullptr, {"x", "y", "z"}},
      {"fit.weights", kChoice, "", {}, "samples",
       "samples: every newton counts alike; records: every record does, whatever its forces", nullptr,
       {"samples", "records"}},
      {"fit.loss", kChoice, "", {}, "none", "how large residuals count: huber and cauchy hold against spikes", nullptr,
       {"none", "huber", "cauchy"}},
      {"fit.loss_scale_N", kNumber, "N", up_to(1e6), Optional{}, "residual from which the loss counts less"},
      {"fit.phase_drift_knots", kInteger, "", {4.0, 1000.0}, 60.0,
       "knots of the spline for the wandering of the spindle angle, with phase_drift"},
      {"fit.runout_limit_mm", kNumber, "mm", up_to(10.0), 0.05, "largest component of the runout"},
      {"fit.reference_chip_thickness_mm", kNumber, "mm", up_to(10.0), 0.1,
       "chip thickness h0 at which the coefficients of model exponential are given"},
      {"fit.below_Hz", kNumber, "Hz", up_to(1e6), Optional{},
       "forces are fitted and compared below this frequency only"},
      {"fit.tolerance", kNumber, "", {1e-14, 1e-2}, 1e-8, "relative decrease of the cost at which the solver is done"},
      {"fit.max_iterations", kInteger, "", {1.0, 10000.0}, 100.0, "iterations of the solver: at most"},
      {"fit.bootstrap", kInteger, "", {20.0, 100000.0}, Optional{},
       "samples of a bootstrap over revolutions: errors and 95 % intervals that assume no distribution; 200 are usual"},
      {"fit.seed", kInteger, "", {0.0, 2147483647.0}, 1.0, "seed of the bootstrap"},
      {"fit.fixed", kTable, "", {}, Optional{}, "coefficients that are known: Kte_N_per_mm = 0.0"},
      {"fit.prior", kTable, "", {}, Optional{},
       "coefficients that are known roughly: Kac_N_per_mm2 = { mean = 700.0, deviation = 100.0 }"},
  };
  return keys;
}

std::span<const Key> source_keys() {
  static const std::vector<Key> keys = {
      {"trace.axes", kTable, "", {}, Required{},
       "channels that are forces on the tool along x, y, z, with signs: { x = \"-Fy\", y = \"-Fx\", z = \"Fz\" }"},
      {"trace.sampling_rate_Hz", kNumber, "Hz", up_to(1e8), Optional{}, "sampling rate; else that of the file"},
      {"trace.window_s", kNumbers, "s", {}, Optional{}, "time window: from, to on the clock of the file", nullptr, {}, {}, {2, 2}},
      {"trace.cutting_only", kFlag, "", {}, Optional{},
       "keep only the revolutions in which the tool cuts steadily, by how the forces vary"},
      {"trace.offset_from_air", kFlag, "", {}, Optional{},
       "take offset and drift of each axis from air cutting before and after the cut, and remove them"},
      {"trace.variables", kTable, "", {}, Optional{},
       "channels by what the file calls them: { Fx = \"Fx_R_1\" }; columns of text files by name or number"},
      {"trace.units", kTable, "", {}, Optional{}, "units of channels, where the file says none: { Fx = \"kN\" }"},
      {"trace.sensitivity_N_per_V", kTable, "", {}, Optional{}, "of channels in volts: { Fx = 200.0 }"},
      {"trace.point", kInteger, "", {0.0, 1e15}, Optional{}, "point of one of our result files, counted from 0"},
      {"trace.segment", kInteger, "", {1.0, 1e6}, Optional{}, "segment of a LabVIEW file, counted from 1"},
  };
  return keys;
}

std::span<const Key> record_keys() {
  static const std::vector<Key> keys = {
      {"record.file", kText, "", {}, Required{}, "file of the trace, relative to the fit file; all keys of [trace] may stand here too"},
      {"record.name", kText, "", {}, "", "for tables; else the name of the file"},
      {"record.cut", kTable, "", {}, Optional{}, "keys of [cut] that are different for this record"},
      {"record.phase_deg", kNumber, "deg", within(1e6), Optional{},
       "immersion angle of flute 0's tip at the first sample, where phase is not estimated"},
  };
  return keys;
}

std::span<const Key> mode_keys() {
  static const std::vector<Key> keys = {
      {"dynamometer.x.frequency_Hz", kNumber, "Hz", up_to(1e6), Required{},
       "natural frequency: of the dynamometer along x, in a list [[dynamometer.x]]"},
      {"dynamometer.x.damping_ratio", kNumber, "", {0.0, 1.0, false, true}, Required{}, "its damping ratio"},
      {"dynamometer.x.gain", kNumber, "", within(1e3), 1.0, "its share in the signal; 1 for a single mode"},
      {"dynamometer.y.frequency_Hz", kNumber, "Hz", up_to(1e6), Required{}, "natural frequency: along y, in a list [[dynamometer.y]]"},
      {"dynamometer.y.damping_ratio", kNumber, "", {0.0, 1.0, false, true}, Required{}, "its damping ratio"},
      {"dynamometer.y.gain", kNumber, "", within(1e3), 1.0, "its share in the signal"},
      {"dynamometer.z.frequency_Hz", kNumber, "Hz", up_to(1e6), Required{}, "natural frequency: along z, in a list [[dynamometer.z]]"},
      {"dynamometer.z.damping_ratio", kNumber, "", {0.0, 1.0, false, true}, Required{}, "its damping ratio"},
      {"dynamometer.z.gain", kNumber, "", within(1e3), 1.0, "its share in the signal"},
  };
  return keys;
}

// clang-format on

}  // namespace

const Kind& fit_keys() {
  static const Kind kind = {"fit",
                            "coefficients from measured force traces (a fit file, not a study)",
                            {version_keys(), method_keys(), source_keys(), record_keys(),
                             mode_keys(), cutter_keys(), cut_keys()},
                            nullptr,
                            false,
                            nullptr,
                            nullptr,
                            nullptr};
  return kind;
}

}  // namespace millstudy::study
