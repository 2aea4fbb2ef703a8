// SPDX-License-Identifier: MIT
#include "study/validity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "study/point_case.h"

namespace millstudy::study {
namespace {

struct Quantity {
  std::string_view name;
  std::string_view key;  ///< of its range
  double (*native)(const Case&);
  std::vector<double> Validity::*range;
};

constexpr std::array<Quantity, 3> kQuantities = {{
    {"feed per tooth", "coefficients.valid_feed_per_tooth_mm", feed_per_tooth,
     &Validity::feed_per_tooth},
    {"cutting speed", "coefficients.valid_cutting_speed_m_per_min", cutting_speed,
     &Validity::cutting_speed},
    {"axial depth", "coefficients.valid_axial_depth_mm",
     [](const Case& point) { return point.cut.axial_depth; }, &Validity::axial_depth},
}};

/// What a quantity is over the points that were looked at, and the first range that it leaves.
struct Seen {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  std::vector<double> left;
};

void look(const Quantity& quantity, const Case& point, Seen& seen) {
  constexpr double kRounding = 1e-12;
  const double value = quantity.native(point);
  seen.least = std::min(seen.least, value);
  seen.most = std::max(seen.most, value);
  const std::vector<double>& range = point.valid.*quantity.range;
  if (range.size() != 2 || !seen.left.empty()) return;
  const double slack = kRounding * std::abs(value);
  if (value < range[0] - slack || value > range[1] + slack) seen.left = range;
}

/// Numbers of the points to look at, in order: all, or evenly spread ones and, of a grid, those at
/// the ends of the axes.
std::vector<std::int64_t> looked_at(const Study& study) {
  constexpr std::int64_t kMost = 20'000;
  const std::int64_t points = study.space.points();
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < std::min(points, kMost); ++i) {
    numbers.push_back(points <= kMost
                          ? i
                          : static_cast<std::int64_t>(static_cast<double>(points - 1) *
                                                      static_cast<double>(i) / (kMost - 1)));
  }
  constexpr std::size_t kMostAxes = 14;
  if (points <= kMost || study.axes.size() > kMostAxes ||
      study.space.design() != sweep::Design::grid) {
    return numbers;
  }
  std::vector<std::int64_t> corners = {0};
  for (const Axis& axis : study.axes) {
    // Of an axis, the least and the most; of labels, what they are is not known: the first and
    // last.
    const auto length = static_cast<std::int64_t>(axis.size());
    const auto [least, most] = std::minmax_element(axis.numbers.begin(), axis.numbers.end());
    const std::int64_t low = axis.numeric() ? least - axis.numbers.begin() : 0;
    const std::int64_t high = axis.numeric() ? most - axis.numbers.begin() : length - 1;
    std::vector<std::int64_t> next;
    for (const std::int64_t corner : corners) {
      next.push_back(corner * length + low);
      next.push_back(corner * length + high);
    }
    corners = std::move(next);
  }
  numbers.insert(numbers.end(), corners.begin(), corners.end());
  return numbers;
}

std::string text_of(const Quantity& quantity, const Seen& seen, const Unit& unit) {
  const auto shown = [&](double native) {
    return fmt::format("{:.6g}", native * unit.divisor / unit.factor);
  };
  const std::string least = shown(seen.least);
  const std::string most = shown(seen.most);
  return fmt::format("{} of {}{} {} leaves {} = [{}, {}]: the coefficients are extrapolated",
                     quantity.name, least, least == most ? "" : " to " + most, unit.name,
                     quantity.key, shown(seen.left[0]), shown(seen.left[1]));
}

}  // namespace

std::vector<core::Fault> left_validity(const Study& study, const Given& given) {
  std::vector<core::Fault> warnings;
  const bool any = std::any_of(kQuantities.begin(), kQuantities.end(),
                               [&](const Quantity& quantity) { return given.has(quantity.key); });
  if (!any) return warnings;
  std::array<Seen, kQuantities.size()> seen;
  PointCase point(study);
  for (const std::int64_t number : looked_at(study)) {
    const Case& now = point.at(number);
    if (!within_limits(study, now)) continue;
    for (std::size_t q = 0; q < kQuantities.size(); ++q) look(kQuantities[q], now, seen[q]);
  }
  for (std::size_t q = 0; q < kQuantities.size(); ++q) {
    if (seen[q].left.empty()) continue;
    const std::string_view key = kQuantities[q].key;
    warnings.push_back({given.place({key}), text_of(kQuantities[q], seen[q],
                                                    unit_named(study.kind->find_key(key)->unit))});
  }
  return warnings;
}

}  // namespace millstudy::study
