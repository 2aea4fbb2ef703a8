// SPDX-License-Identifier: MIT
// The verb sensitivity: Sobol' indices of a result whose design is saltelli.
#include "sweep/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/progress.h"
#include "core/error.h"
#include "io/result_blocks.h"
#include "io/text_file.h"
#include "sweep/attributes.h"

namespace millstudy::cli {
namespace {

struct VariableSensitivity {
  sweep::Column column;
  sweep::Sensitivity indices;
};

/// Values of some columns over all points, NaN where a point has none; shape (columns, points).
std::vector<std::vector<double>> read_columns(const io::ResultBlocks& result,
                                              const std::vector<std::size_t>& columns) {
  constexpr std::int64_t kAtOnce = 1 << 14;
  const std::int64_t points = result.layout().points();
  std::vector<std::vector<double>> values(columns.size());
  for (auto& one : values) one.reserve(static_cast<std::size_t>(points));
  for (std::int64_t first = 0; first < points; first += kAtOnce) {
    const std::int64_t count = std::min(kAtOnce, points - first);
    const sweep::Block block = result.read(first, count);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      for (std::int64_t i = 0; i < count; ++i) {
        values[c].push_back(block.values.empty() ? std::nan("") : block.value(columns[c], i));
      }
    }
  }
  return values;
}

std::vector<std::size_t> chosen_columns(const sweep::Layout& layout,
                                        const std::vector<std::string>& names) {
  std::vector<std::size_t> chosen;
  std::vector<core::Fault> faults;
  for (const std::string& name : names) {
    const auto at = std::find_if(layout.columns.begin(), layout.columns.end(),
                                 [&](const sweep::Column& column) { return column.name == name; });
    if (at == layout.columns.end()) {
      faults.emplace_back();
      faults.back().place.file = "--variable " + name;
      faults.back().text = "the result has no variable of this name";
    } else {
      chosen.push_back(static_cast<std::size_t>(at - layout.columns.begin()));
    }
  }
  if (!faults.empty()) throw core::InputError(faults);
  if (!names.empty()) return chosen;
  for (std::size_t c = 0; c < layout.columns.size(); ++c) chosen.push_back(c);
  return chosen;
}

nlohmann::json json_of(const sweep::Interval& interval) {
  // NaN is null in JSON.
  return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

void print_json(const std::vector<VariableSensitivity>& all, const sweep::Layout& layout) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [column, found] : all) {
    nlohmann::json axes = nlohmann::json::array();
    for (std::size_t i = 0; i < found.axes.size(); ++i) {
      axes.push_back({{"axis", layout.coordinates[i].key},
                      {"first", json_of(found.axes[i].first)},
                      {"total", json_of(found.axes[i].total)}});
    }
    list.push_back({{"variable", column.name},
                    {"units", column.units},
                    {"mean", found.mean},
                    {"standard_deviation", std::sqrt(found.variance)},
                    {"groups", found.groups},
                    {"dropped_groups", found.dropped},
                    {"axes", axes}});
  }
  fmt::print("{}\n", list.dump(2));
}

std::string text_of(const sweep::Interval& x) {
  const auto digits = [](double part) { return std::abs(part) < 5e-4 ? 0.0 : part; };  // no -0.000
  return fmt::format("{:6.3f} ({:.3f} to {:.3f})", digits(x.value), digits(x.low), digits(x.high));
}

void print_text(const std::vector<VariableSensitivity>& all, const sweep::Layout& layout) {
  std::size_t width = 4;
  for (const auto& axis : layout.coordinates) width = std::max(width, axis.key.size());
  for (const auto& [column, found] : all) {
    const std::string unit = column.units == "1" ? "" : ' ' + column.units;
    fmt::print("{}: mean {:.4g}{}, standard deviation {:.4g}{}, {} groups", column.name, found.mean,
               unit, std::sqrt(found.variance), unit, count_text(found.groups));
    if (found.dropped > 0) {
      fmt::print(", {} dropped: not all of their points have a value", count_text(found.dropped));
    }
    fmt::print("\n");
    if (std::isnan(found.axes[0].first.value)) {
      fmt::print("  does not vary\n");
      continue;
    }
    fmt::print("  {:<{}}  {:<24}  {}\n", "axis", width, "alone (95 %)", "in all (95 %)");
    for (std::size_t i = 0; i < found.axes.size(); ++i) {
      fmt::print("  {:<{}} {:<25} {}\n", layout.coordinates[i].key, width,
                 text_of(found.axes[i].first), text_of(found.axes[i].total));
    }
  }
}

std::string csv_of(const std::vector<VariableSensitivity>& all, const sweep::Layout& layout) {
  std::string text =
      "variable,axis,first,first_low,first_high,total,total_low,total_high,groups,dropped_groups\n";
  for (const auto& [column, found] : all) {
    for (std::size_t i = 0; i < found.axes.size(); ++i) {
      const auto& [first, total] = found.axes[i];
      text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", column.name, layout.coordinates[i].key,
                          first.value, first.low, first.high, total.value, total.low, total.high,
                          found.groups, found.dropped);
    }
  }
  return text;
}

}  // namespace

int sensitivity(const SensitivityOptions& options) {
  const io::ResultBlocks result(options.result);
  const sweep::Layout& layout = result.layout();
  const auto axes = static_cast<std::int64_t>(layout.coordinates.size());
  if (sweep::text_attribute(layout, "design") != "saltelli" || axes == 0 ||
      layout.points() % (axes + 2) != 0) {
    throw core::InputError({options.result, 0},
                           "is not of a saltelli design: give the study sweep.design = "
                           "\"saltelli\" and sweep.samples, and run it");
  }
  const std::vector<std::size_t> columns = chosen_columns(layout, options.variables);
  std::vector<VariableSensitivity> all;
  for (std::size_t c = 0; const auto& values : read_columns(result, columns)) {
    all.push_back(
        {layout.columns[columns[c++]], sweep::sobol_indices(values, static_cast<int>(axes))});
  }
  if (!options.output.empty()) io::write_text_file(options.output, csv_of(all, layout));
  if (options.json) {
    print_json(all, layout);
  } else {
    print_text(all, layout);
  }
  return kDone;
}

}  // namespace millstudy::cli
