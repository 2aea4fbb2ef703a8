// SPDX-License-Identifier: MIT
#include "process/stock.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "process/chord.h"

namespace millstudy::process {
namespace {

/// Chords below this part of the longest have no direction to rely on.
constexpr double kShortChord = 0.1;

/// Direction of the path at its first point, or of the reversed path at the last one [rad].
double direction_from(const path::Interpolation& path, std::int64_t end, double shortest) {
  const std::int64_t step = end == 0 ? 1 : -1;
  const auto count = static_cast<std::int64_t>(path.points.size());
  for (std::int64_t i = end + step; i >= 0 && i < count; i += step) {
    const path::Vec3 way = path.points[i] - path.points[end];
    const double distance = std::hypot(way.x, way.y);
    if (distance > 0.0 && distance >= shortest) return std::atan2(way.y, way.x);
  }
  return 0.0;
}

double longest_chord(const path::Interpolation& path) {
  double longest = 0.0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const path::Vec3 way = path.points[i] - path.points[i - 1];
    longest = std::max(longest, std::hypot(way.x, way.y));
  }
  return longest;
}

}  // namespace

StockEnds::StockEnds(const path::Interpolation& path, double radius, Stock stock)
    : path_(&path), radius_(radius) {
  const auto periods = static_cast<std::int64_t>(path.points.size()) - 1;
  const double shortest = kShortChord * longest_chord(path);
  leaving_ = periods;
  if (stock == Stock::entry || stock == Stock::both) {
    entry_ = {path.points.front(), direction_from(path, 0, shortest), radius};
    while (entered_ < periods && !is_inside(entry_, entered_)) ++entered_;
  }
  if (stock == Stock::exit || stock == Stock::both) {
    exit_ = {path.points.back(), direction_from(path, periods, shortest), 0.0};
    while (leaving_ > 0 && !is_inside(exit_, leaving_ - 1)) --leaving_;
  }
}

ArcSet StockEnds::within(const ArcSet& set, std::int64_t i, double feed_direction) const {
  ArcSet kept = set;
  if (i < entered_) kept = within(kept, entry_, i, feed_direction);
  if (i >= leaving_) kept = within(kept, exit_, i, feed_direction);
  return kept;
}

ArcSet StockEnds::within(const ArcSet& set, const Face& face, std::int64_t i,
                         double feed_direction) const {
  const path::Vec3 centre = 0.5 * (path_->points[i] + path_->points[i + 1]) - face.point;
  const double inside =
      centre.x * std::cos(face.direction) + centre.y * std::sin(face.direction) - face.offset;
  return within_cap(set, feed_direction - face.direction, -inside / radius_);  // (M8), (M9)
}

bool StockEnds::is_inside(const Face& face, std::int64_t i) const {
  const path::Vec3 way = path_->points[i + 1] - path_->points[i];
  if (way.x == 0.0 && way.y == 0.0) return false;  // at rest: the next one that moves decides
  const ArcSet half_turn(force::Arc{0.0, core::kPi});
  return within(half_turn, face, i, std::atan2(way.y, way.x)) == half_turn;
}

}  // namespace millstudy::process
