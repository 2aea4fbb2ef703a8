// SPDX-License-Identifier: MIT
#include "study/response_file.h"

#include <fmt/core.h>
#include <utility>

#include "core/units.h"
#include "study/faults.h"
#include "study/file_text.h"
#include "study/suggest.h"

namespace millstudy::study {
namespace {

constexpr std::size_t kMostPoints = 100'000;

void check_keys(const core::Value& table, Faults& faults) {
  constexpr std::array<std::string_view, 7> kKnown = {"points", "unit",    "name",       "source",
                                                      "units",  "licence", "description"};
  for (const auto& [name, value] : table.table()) {
    if (name == "points") continue;
    if (name != "unit" && !is_file_text(name)) {
      faults.add(value.place, fmt::format("{} is not a key of a frequency response{}", name,
                                          suggestion(name, kKnown)));
    } else if (!value.is_string()) {
      faults.add(value.place, fmt::format("{} must be a string, not {}", name, type_name(value)));
    }
  }
}

/// What a number of that unit is in mm/N; 0 where it is none.
double compliance_unit(const core::Value& table, Faults& faults) {
  const core::Value* unit = table.find("unit");
  if (!unit) {
    faults.add(table.place, "the frequency response has no unit: \"m/N\", \"mm/N\" or \"um/N\"");
    return 0.0;
  }
  if (!unit->is_string()) return 0.0;  // told already
  constexpr std::array<std::pair<std::string_view, double>, 5> kUnits = {
      {{"m/N", 1e3}, {"mm/N", 1.0}, {"um/N", 1e-3}, {"µm/N", 1e-3}, {"μm/N", 1e-3}}};
  for (const auto& [name, factor] : kUnits) {
    if (unit->string() == name) return factor;
  }
  faults.add(unit->place, fmt::format("unit \"{}\" is not displacement over force: it must be "
                                      "m/N, mm/N or um/N",
                                      unit->string()));
  return 0.0;
}

}  // namespace

ResponsePtr read_response(const core::Value& table) {
  Faults faults;
  check_keys(table, faults);
  const double unit = compliance_unit(table, faults);
  StudyResponse read;
  const auto measured = std::make_shared<dynamics::MeasuredResponse>();
  std::vector<core::Place> places;
  const core::Value* points = table.find("points");
  if (!points || !points->is_array()) {
    faults.add(points ? points->place : table.place,
               "the frequency response has no points: a list of [Hz, real, imaginary]");
  } else if (points->array().size() > kMostPoints) {
    faults.add(points->place,
               fmt::format("{} points are more than {}", points->array().size(), kMostPoints));
  } else {
    read.canonical = "response";
    for (const core::Value& item : points->array()) {
      const std::string name = fmt::format("points[{}]", places.size());
      const std::vector<double> numbers = number_list(item, name, faults);
      places.push_back(item.place);
      if (numbers.size() != 3) {
        if (!item.is_array() || numbers.size() < item.array().size()) continue;  // told already
        faults.add(item.place, fmt::format("{} has {} numbers, not a frequency, a real and an "
                                           "imaginary part",
                                           name, numbers.size()));
        continue;
      }
      measured->omega.push_back(core::kTurn * numbers[0]);
      measured->compliance.emplace_back(unit * numbers[1], unit * numbers[2]);
      read.canonical += fmt::format(" {} {} {}", numbers[0], unit * numbers[1], unit * numbers[2]);
    }
  }
  faults.throw_if_any();
  for (const dynamics::ResponseFault& fault : dynamics::faults(*measured)) {
    faults.add(fault.at < places.size() ? places[fault.at] : table.place, fault.text);
  }
  faults.throw_if_any();
  read.fit = identify::fit_modes(*measured);
  read.measured = measured;
  return std::make_shared<const StudyResponse>(std::move(read));
}

}  // namespace millstudy::study
