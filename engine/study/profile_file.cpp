// SPDX-License-Identifier: MIT
#include "study/profile_file.h"

#include <cmath>
#include <fmt/core.h>

#include "study/faults.h"
#include "study/file_text.h"
#include "study/suggest.h"

namespace millstudy::study {
namespace {

constexpr std::size_t kMostPoints = 1000;
constexpr double kLargest = 1e4;  // [mm]

void check_keys(const core::Value& table, Faults& faults) {
  constexpr std::array<std::string_view, 6> kKnown = {"points_mm", "name",    "source",
                                                      "units",     "licence", "description"};
  for (const auto& [name, value] : table.table()) {
    if (name == "points_mm") continue;
    if (!is_file_text(name)) {
      faults.add(value.place,
                 fmt::format("{} is not a key of a profile{}", name, suggestion(name, kKnown)));
    } else if (!value.is_string()) {
      faults.add(value.place, fmt::format("{} must be a string, not {}", name, type_name(value)));
    }
  }
}

void add_point(const core::Value& item, cutter::Profile& profile, Faults& faults) {
  const std::string name = fmt::format("points_mm[{}]", profile.size());
  const std::vector<double> zr = number_list(item, name, faults);
  profile.push_back({});  // so that a faulty one counts, too
  if (!item.is_array() || zr.size() < item.array().size()) return;
  if (zr.size() != 2) {
    return faults.add(item.place, fmt::format("{} has {} numbers, not z and r", name, zr.size()));
  }
  const auto [z, r] = profile.back() = {zr[0], zr[1]};
  if (!(std::abs(z) <= kLargest && std::abs(r) <= kLargest)) {
    faults.add(item.place, fmt::format("{} must be within {} mm", name, kLargest));
  } else if (profile.size() == 1 && z != 0.0) {
    faults.add(item.place, fmt::format("{}: z = {} mm must be 0, the tip", name, z));
  } else if (profile.size() > 1 && z <= profile[profile.size() - 2].z) {
    faults.add(item.place, fmt::format("{}: z = {} mm must be above the one before", name, z));
  } else if (r < 0.0) {
    faults.add(item.place, fmt::format("{}: r = {} mm must be >= 0", name, r));
  }
}

}  // namespace

ProfilePtr read_profile(const core::Value& table) {
  Faults faults;
  check_keys(table, faults);
  cutter::Profile profile;
  const core::Value* points = table.find("points_mm");
  if (!points) {
    faults.add(table.place, "the profile has no points_mm");
  } else if (!points->is_array()) {
    faults.add(points->place,
               fmt::format("points_mm must be a list of [z, r], not {}", type_name(*points)));
  } else if (points->array().size() < 2 || points->array().size() > kMostPoints) {
    const std::size_t count = points->array().size();
    faults.add(points->place, fmt::format("points_mm has {} point{}, not 2 to {}", count,
                                          count == 1 ? "" : "s", kMostPoints));
  } else {
    for (const core::Value& item : points->array()) add_point(item, profile, faults);
  }
  faults.throw_if_any();
  return std::make_shared<const cutter::Profile>(std::move(profile));
}

}  // namespace millstudy::study
