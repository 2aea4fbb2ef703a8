// SPDX-License-Identifier: MIT
// Keys of [[modes.x]], [[modes.y]] and [[modes.coupled]], and what must hold between them.
#include <deque>
#include <fmt/format.h>

#include "core/error.h"
#include "core/units.h"
#include "cutter/flutes.h"
#include "study/key_table.h"
#include "study/kind.h"

namespace millstudy::study {
namespace {

using namespace table;

constexpr Range kDamping = {0.0, 1.0, true, true};
constexpr Range kFrequencies = {1e-3, 1e6};

/// Paths that are made, not written: they outlive every key.
std::string_view kept(std::string path) {
  static std::deque<std::string> paths;
  return paths.emplace_back(std::move(path));
}

// clang-format off

void add_axis(std::vector<Key>& keys, std::string_view axis, std::string_view words,
              std::array<AxisModeSection, ModesSection::kMost> ModesSection::*list, int item) {
  const auto path = [&](std::string_view name) { return kept(fmt::format("modes.{}.{}.{}", axis, item, name)); };
  const auto sets = [list, item](std::optional<double> AxisModeSection::*member) {
    return [=](Case& c) -> Field { return &((c.modes.*list)[item].*member); };
  };
  keys.push_back({path("frequency_Hz"), kNumber, "Hz", kFrequencies, Optional{},
                  words, sets(&AxisModeSection::frequency), {}, {}, {}, item});
  keys.push_back({path("damping_ratio"), kNumber, "", kDamping, Optional{},
                  "damping ratio", sets(&AxisModeSection::damping_ratio), {}, {}, {}, item});
  keys.push_back({path("mass_kg"), kNumber, "kg", up_to(1e6), Optional{},
                  "modal mass; or stiffness_N_per_m", sets(&AxisModeSection::mass), {}, {}, {}, item});
  keys.push_back({path("stiffness_N_per_m"), kNumber, "N/m", up_to(1e13), Optional{},
                  "modal stiffness; or mass_kg", sets(&AxisModeSection::stiffness), {}, {}, {}, item});
}

void add_coupled(std::vector<Key>& keys, int item) {
  const auto path = [&](std::string_view name) { return kept(fmt::format("modes.coupled.{}.{}", item, name)); };
  keys.push_back({path("frequency_Hz"), kNumber, "Hz", kFrequencies, Optional{},
                  "natural frequency: of a mode that couples x and y, in a list [[modes.coupled]] of at most 4",
                  [=](Case& c) -> Field { return &c.modes.coupled[item].frequency; }, {}, {}, {}, item});
  keys.push_back({path("damping_ratio"), kNumber, "", kDamping, Optional{}, "damping ratio",
                  [=](Case& c) -> Field { return &c.modes.coupled[item].damping_ratio; }, {}, {}, {}, item});
  keys.push_back({path("residue_per_kg"), kNumbers, "1/kg", within(1e9), Optional{},
                  "residues: of displacement over force, xx, xy, yx, yy",
                  [=](Case& c) -> Field { return &c.modes.coupled[item].residue; }, {}, {}, {4, 4}, item});
}

std::vector<Key> make_keys() {
  std::vector<Key> keys = {
      {"modes.modes_file", kFile, "", {}, Optional{},
       "modes: [[x]], [[y]] and [[coupled]] from a TOML file, where they are not given here"},
      {"modes.response_x_file", kFile, "", {}, Optional{},
       "frequency response along x: measured, as .frf, CSV, HDF5 or TOML; its modes besides those given here", MILLSTUDY_SETS(modes.response_x)},
      {"modes.response_y_file", kFile, "", {}, Optional{},
       "frequency response along y: as along x", MILLSTUDY_SETS(modes.response_y)},
  };
  for (int i = 0; i < static_cast<int>(ModesSection::kMost); ++i) {
    add_axis(keys, "x", "natural frequency: of tool or workpiece along x, in a list [[modes.x]] of at most 8", &ModesSection::x, i);
  }
  for (int i = 0; i < static_cast<int>(ModesSection::kMost); ++i) {
    add_axis(keys, "y", "natural frequency: of tool or workpiece along y, in a list [[modes.y]] of at most 8", &ModesSection::y, i);
  }
  for (int i = 0; i < static_cast<int>(ModesSection::kMostCoupled); ++i) add_coupled(keys, i);
  return keys;
}

// clang-format on

/// Faults of one mode. @return true if there is one
bool check_mode(const Given& given, const std::string& mode, bool coupled, Faults& faults) {
  const auto path = [&](std::string_view name) { return fmt::format("{}.{}", mode, name); };
  const auto has = [&](std::string_view name) { return given.has(path(name)); };
  const std::vector<std::string_view> names =
      coupled ? std::vector<std::string_view>{"frequency_Hz", "damping_ratio", "residue_per_kg"}
              : std::vector<std::string_view>{"frequency_Hz", "damping_ratio", "mass_kg",
                                              "stiffness_N_per_m"};
  std::string given_one;
  for (const std::string_view name : names) {
    if (has(name)) given_one = path(name);
  }
  if (given_one.empty()) return false;
  const core::Place place = given.entries.find(given_one)->second.place;
  const auto need = [&](std::string_view name, std::string_view words) {
    if (!has(name)) faults.add(place, fmt::format("{} is missing: {}", path(name), words));
  };
  need("frequency_Hz", "natural frequency [Hz]");
  need("damping_ratio", "damping ratio");
  if (coupled) {
    need("residue_per_kg", "residues xx, xy, yx, yy [1/kg]");
  } else if (has("mass_kg") && has("stiffness_N_per_m")) {
    faults.add(place, fmt::format("{} contradicts {}: give one of them", path("stiffness_N_per_m"),
                                  path("mass_kg")));
  } else if (!has("mass_kg") && !has("stiffness_N_per_m")) {
    faults.add(place, fmt::format("{} [kg] or stiffness_N_per_m [N/m] is missing: modal mass or "
                                  "stiffness",
                                  path("mass_kg")));
  }
  return true;
}

}  // namespace

std::span<const Key> modes_keys() {
  static const std::vector<Key> keys = make_keys();
  return keys;
}

void check_modes_keys(const Given& given, Faults& faults) {
  bool any = given.has("modes.modes_file") || given.has("modes.response_x_file") ||
             given.has("modes.response_y_file");
  for (std::size_t i = 0; i < ModesSection::kMost; ++i) {
    for (const std::string_view axis : {"x", "y"}) {
      any |= check_mode(given, fmt::format("modes.{}.{}", axis, i), false, faults);
    }
  }
  for (std::size_t i = 0; i < ModesSection::kMostCoupled; ++i) {
    any |= check_mode(given, fmt::format("modes.coupled.{}", i), true, faults);
  }
  if (any) return;
  faults.add(given.file,
             "modes are missing: give [[modes.x]], [[modes.y]] or both, each with frequency_Hz, "
             "damping_ratio and mass_kg or stiffness_N_per_m; or modes_file, response_x_file, "
             "response_y_file");
}

void check_modes(const Given& given, const Case& base, Faults& faults) {
  const std::initializer_list<std::string_view> keys = {"modes.response_x_file",
                                                        "modes.response_y_file"};
  if (given.any_swept(keys)) return;
  try {
    machine(base);
  } catch (const core::CaseError& error) {
    faults.add(given.place(keys), error.what());
  }
}

std::vector<core::Fault> fitted_modes(const Given& given, const Case& base) {
  std::vector<core::Fault> notes;
  const auto tell = [&](std::string_view key, const ResponsePtr& response) {
    if (!response || given.swept(key)) return;
    std::vector<std::string> modes;
    for (const dynamics::AxisMode& m : response->fit.modes) {
      modes.push_back(fmt::format("{:.1f} Hz, {:.2f} %, {:.4g} N/m",
                                  m.mode.natural_frequency / core::kTurn,
                                  100.0 * m.mode.damping_ratio, 1e3 * m.stiffness));
    }
    notes.push_back({given.place({key}),
                     fmt::format("modes fitted to {}: {}; they leave {:.2g} % of it", key,
                                 fmt::join(modes, "; "), 100.0 * response->fit.unexplained)});
  };
  tell("modes.response_x_file", base.modes.response_x);
  tell("modes.response_y_file", base.modes.response_y);
  return notes;
}

void check_linear_keys(const Given& given, const Case& base, std::string_view method,
                       Faults& faults) {
  const auto refuse = [&](std::initializer_list<std::string_view> keys, std::string_view what) {
    faults.add(
        given.place(keys),
        fmt::format("{} is for {} = \"time_domain\" only: without, the cut is taken as linear",
                    what, method));
  };
  if (cutter::has_runout(base.cutter) ||
      given.any_swept({"cutter.runout_offset_mm", "cutter.runout_tilt_deg"})) {
    refuse({"cutter.runout_offset_mm", "cutter.runout_tilt_deg"}, "runout");
  }
  const std::initializer_list<std::string_view> exponents = {
      "coefficients.Ktc_exponent", "coefficients.Krc_exponent", "coefficients.Kac_exponent"};
  if (variation(base).with_chip() || given.any_swept(exponents)) refuse(exponents, "a size effect");
}

}  // namespace millstudy::study
