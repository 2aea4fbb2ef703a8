// SPDX-License-Identifier: MIT
#include "study/curve_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "core/units.h"
#include "study/faults.h"
#include "study/file_text.h"
#include "study/suggest.h"

namespace millstudy::study {
namespace {

constexpr std::array<std::string_view, 10> kCurveKeys = {
    "degree", "knots",  "points_mm", "points_um", "weights",
    "name",   "source", "units",     "licence",   "description"};
constexpr std::size_t kFirstText = 5;  // from here on: words for people

std::vector<path::Vec3> point_list(const core::Value& value, std::string_view key, double scale,
                                   Faults& faults) {
  std::vector<path::Vec3> points;
  if (!value.is_array()) {
    faults.add(value.place, fmt::format("{} must be a list of [x, y] or [x, y, z], not {}", key,
                                        type_name(value)));
    return points;
  }
  for (const core::Value& item : value.array()) {
    const std::string name = fmt::format("{}[{}]", key, points.size());
    const std::vector<double> xyz = number_list(item, name, faults);
    if (!faults.empty()) return points;
    if (xyz.size() != 2 && xyz.size() != 3) {
      faults.add(item.place, fmt::format("{} has {} coordinates, not 2 or 3", name, xyz.size()));
      return points;
    }
    points.push_back({scale * xyz[0], scale * xyz[1], xyz.size() == 3 ? scale * xyz[2] : 0.0});
  }
  return points;
}

void check_keys(const core::Value& table, Faults& faults) {
  for (const core::Member& member : table.table()) {
    const auto* const known = std::find(kCurveKeys.begin(), kCurveKeys.end(), member.key);
    if (known == kCurveKeys.end()) {
      faults.add(member.value.place, fmt::format("{} is not a key of a curve{}", member.key,
                                                 suggestion(member.key, kCurveKeys)));
    } else if (known - kCurveKeys.begin() >= static_cast<std::ptrdiff_t>(kFirstText) &&
               !member.value.is_string()) {
      faults.add(member.value.place,
                 fmt::format("{} must be a string, not {}", member.key, type_name(member.value)));
    }
  }
}

path::CurveData read_data(const core::Value& table, Faults& faults) {
  path::CurveData data;
  const core::Value* mm = table.find("points_mm");
  const core::Value* um = table.find("points_um");
  if (mm && um) {
    faults.add(um->place, "points_um contradicts points_mm: give one of them");
  } else if (mm || um) {
    data.points = mm ? point_list(*mm, "points_mm", 1.0, faults)
                     : point_list(*um, "points_um", core::mm_from_um(1.0), faults);
  } else {
    faults.add(table.place, "the curve has no points_mm (or points_um)");
  }
  if (const core::Value* degree = table.find("degree")) {
    const double number = degree->is_number() ? degree->number() : 0.0;
    if (number >= 1.0 && number <= 15.0 && number == std::nearbyint(number)) {
      data.degree = static_cast<int>(number);
    } else {
      faults.add(degree->place, "degree must be a whole number from 1 to 15");
    }
  } else {
    faults.add(table.place, "the curve has no degree");
  }
  if (const core::Value* knots = table.find("knots")) {
    data.knots = number_list(*knots, "knots", faults);
  } else {
    faults.add(table.place, "the curve has no knots");
  }
  if (const core::Value* weights = table.find("weights")) {
    data.weights = number_list(*weights, "weights", faults);
  } else {
    data.weights.assign(data.points.size(), 1.0);
  }
  return data;
}

std::string canonical_text(const path::CurveData& data) {
  std::string text = fmt::format("degree {} knots {} weights {} points", data.degree,
                                 fmt::join(data.knots, " "), fmt::join(data.weights, " "));
  for (const path::Vec3& p : data.points) text += fmt::format(" {} {} {}", p.x, p.y, p.z);
  return text;
}

/// Largest slope against the xy plane [rad], at points dense enough to warn of a path that climbs;
/// whether a chord does is judged when it is cut.
double steepest_slope(const path::Curve& curve) {
  constexpr int kPoints = 2000;
  double steepest = 0.0;
  for (int i = 0; i <= kPoints; ++i) {
    const double u = curve.begin() + (curve.end() - curve.begin()) * i / kPoints;
    const path::Vec3 along = curve.evaluate(u).first;
    if (along.z == 0.0) continue;
    steepest = std::max(steepest, std::atan2(std::abs(along.z), std::hypot(along.x, along.y)));
  }
  return steepest;
}

}  // namespace

CurvePtr read_curve(const core::Value& table) {
  Faults faults;
  if (!table.is_table()) {
    throw core::InputError(table.place, "a curve must be a table, with degree, knots and points");
  }
  check_keys(table, faults);
  path::CurveData data = read_data(table, faults);
  faults.throw_if_any();
  for (std::string& text : path::faults(data)) faults.add(table.place, std::move(text));
  faults.throw_if_any();
  std::string canonical = canonical_text(data);
  path::Curve curve(std::move(data));
  const double steepest = steepest_slope(curve);
  return std::make_shared<const StudyCurve>(
      StudyCurve{std::move(curve), std::move(canonical), steepest});
}

}  // namespace millstudy::study
