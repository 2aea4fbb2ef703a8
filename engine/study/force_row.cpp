// SPDX-License-Identifier: MIT
#include <cassert>
#include <fmt/core.h>
#include <limits>

#include "core/error.h"
#include "core/units.h"
#include "study/rows.h"

namespace millstudy::study {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

using Columns = std::vector<sweep::Column>;

void add_statistics(Columns& columns) {
  for (const auto& [axis, words] : {std::pair{"x", "force on the tool along x"},
                                    {"y", "force on the tool along y"},
                                    {"z", "force on the tool along z"},
                                    {"resultant", "resultant force on the tool"}}) {
    for (const auto& [statistic, prefix] : {std::pair{"mean", "mean "},
                                            {"min", "smallest "},
                                            {"max", "largest "},
                                            {"rms", "root mean square "}}) {
      columns.push_back(
          {std::string("force_") + axis + "_" + statistic, "N", std::string(prefix) + words});
    }
  }
}

void add_harmonics(Columns& columns, int harmonics) {
  for (const auto& [name, words, unit] : {std::tuple{"force_x", "force x", "N"},
                                          {"force_y", "force y", "N"},
                                          {"force_z", "force z", "N"},
                                          {"torque", "torque", "N m"}}) {
    for (int n = 1; n <= harmonics; ++n) {
      columns.push_back({fmt::format("{}_harmonic_{}", name, n), unit,
                         fmt::format("amplitude of {}, tooth-passing harmonic {}", words, n)});
    }
  }
}

void add_flutes(Columns& columns, int flutes) {
  constexpr bool kMayBeMissing = true;  // a point can have fewer flutes
  for (int j = 1; j <= flutes; ++j) {
    columns.push_back({fmt::format("flute_{}_chip_thickness_max", j), "mm",
                       fmt::format("largest uncut chip thickness of flute {}", j), kMayBeMissing});
    columns.push_back({fmt::format("flute_{}_load_share", j), "1",
                       fmt::format("part of the mean torque of flute {}", j), kMayBeMissing});
  }
}

}  // namespace

force::FigureRequest figure_request(const Case& point, const Outputs& outputs) {
  if (outputs.harmonics >
      force::Spectrum::most_harmonics(point.cutter.flutes, point.angular_steps)) {
    throw core::CaseError(
        "output.harmonics x cutter.flutes must be <= half of numerics.angular_steps");
  }
  return {outputs.harmonics, outputs.flutes > 0,
          outputs.bending_moment ? point.stick_out : std::nullopt};
}

std::vector<sweep::Column> force_columns(const Outputs& outputs) {
  Columns columns;
  add_statistics(columns);
  columns.insert(
      columns.end(),
      {
          {"torque_mean", "N m", "mean spindle torque"},
          {"torque_max", "N m", "largest spindle torque"},
          {"power_mean", "W", "mean cutting power"},
          {"chip_thickness_max", "mm", "largest uncut chip thickness"},
          {"feed_per_tooth", "mm", "commanded feed per tooth"},
          {"material_removal_rate", "cm3 min-1", "material removal rate"},
          {"power_max", "W", "largest cutting power"},
          {"cutting_time_fraction", "1", "part of the time with a force on the tool"},
          {"specific_energy", "J mm-3", "mean cutting power per material removal rate", true},
      });
  if (outputs.bending_moment) {
    columns.push_back({"bending_moment_max", "N m", "largest bending moment at the holder", true});
  }
  add_harmonics(columns, outputs.harmonics);
  add_flutes(columns, outputs.flutes);
  return columns;
}

void fill_force_row(const Case& point, const Outputs& outputs, const force::ForceFigures& figures,
                    double removal_rate, std::span<double> row) {
  std::size_t c = 0;
  const auto put = [&](double value) { row[c++] = value; };
  const force::ForceStatistics& force = figures.statistics;
  for (const force::Statistics& s : {force.x, force.y, force.z, force.resultant}) {
    for (const double value : {s.mean, s.min, s.max, s.rms}) put(value);
  }
  const double angular_speed = core::kTurn * point.cut.spindle_speed;  // [rad/s]
  const double torque_mean = core::newton_metre(force.torque_mean);
  const double torque_max = core::newton_metre(force.torque_max);
  put(torque_mean);
  put(torque_max);
  put(torque_mean * angular_speed);
  put(figures.chip_thickness_max);
  put(feed_per_tooth(point));
  put(core::cm3_per_min_from_mm3_per_s(material_removal_rate(point)));
  put(torque_max * angular_speed);
  put(force.cutting_fraction);
  put(removal_rate > 0.0 ? torque_mean * angular_speed / removal_rate : kNone);
  if (outputs.bending_moment) {
    put(point.stick_out ? core::newton_metre(figures.bending_moment_max) : kNone);
  }
  for (std::size_t q = 0; q < figures.harmonics.size(); ++q) {
    assert(std::ssize(figures.harmonics[q]) == outputs.harmonics);
    for (const double amplitude : figures.harmonics[q]) {
      put(q == 3 ? core::newton_metre(amplitude) : amplitude);
    }
  }
  for (int j = 0; j < outputs.flutes; ++j) {
    const bool there = j < std::ssize(figures.flutes);
    put(there ? figures.flutes[j].chip_thickness_max : kNone);
    put(there ? figures.flutes[j].load_share : kNone);
  }
}

}  // namespace millstudy::study
