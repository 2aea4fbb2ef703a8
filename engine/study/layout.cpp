// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <set>

#include "study/study.h"

namespace millstudy::study {
namespace {

constexpr std::array<std::string_view, 5> kReserved = {"status", "failure", "failure_code", "point",
                                                       "sample"};

std::string whole_name(std::string path) {
  std::replace(path.begin(), path.end(), '.', '_');
  return path;
}

/// The last part of a path, or all of it where that would name two things.
std::vector<std::string> coordinate_names(const Study& study) {
  std::multiset<std::string_view> taken(kReserved.begin(), kReserved.end());
  for (const sweep::Column& column : study.columns) taken.insert(column.name);
  for (const Axis& axis : study.axes) taken.insert(axis.key->name());
  std::vector<std::string> names;
  for (const Axis& axis : study.axes) {
    const bool unique = taken.count(axis.key->name()) == 1;
    names.push_back(unique ? std::string(axis.key->name()) : whole_name(axis.path));
  }
  return names;
}

}  // namespace

sweep::Layout layout(const Study& study) {
  sweep::Layout result;
  const std::vector<std::string> names = coordinate_names(study);
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const Axis& axis = study.axes[a];
    sweep::Coordinate coordinate{names[a], axis.path,
                                 std::string(unit_named(axis.key->unit).udunits),
                                 std::string(axis.key->label()), axis.numbers};
    if (!axis.numeric()) coordinate.values = axis.labels;
    if (study.space.design() == sweep::Design::grid) {
      result.dimensions.push_back(names[a]);
      result.shape.push_back(static_cast<std::int64_t>(axis.size()));
    }
    result.coordinates.push_back(std::move(coordinate));
  }
  if (study.space.design() != sweep::Design::grid && !study.axes.empty()) {
    result.dimensions = {"point"};
    result.shape = {study.space.points()};
  }
  result.columns = study.columns;
  result.traces = study.outputs.traces && study.kind->has_traces;
  return result;
}

}  // namespace millstudy::study
