// SPDX-License-Identifier: MIT
#include "process/bend.h"

#include <algorithm>
#include <cmath>

#include "process/chord.h"

namespace millstudy::process {
namespace {

/// The path without the chords that are too short to have a direction.
struct Polyline {
  std::vector<std::size_t> points;  ///< numbers of the points kept, shape (chords + 1)
  std::vector<double> begin;        ///< length up to each of them [mm]

  std::size_t chords() const { return points.size() - 1; }
  double length(std::size_t chord) const { return begin[chord + 1] - begin[chord]; }
  double middle(std::size_t chord) const { return 0.5 * (begin[chord] + begin[chord + 1]); }
};

/// The turn at the point between two chords.
struct Turn {
  double angle = 0.0;      ///< [rad]
  double curvature = 0.0;  ///< (M6) [1/mm]
  double at = 0.0;         ///< the length along the path that it belongs to [mm]
};

double distance(const path::Vec3& a, const path::Vec3& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

Polyline without_short_chords(const std::vector<path::Vec3>& points) {
  constexpr double kShortChord = 1e-3;  // of the longest
  double longest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    longest = std::max(longest, distance(points[i - 1], points[i]));
  }
  Polyline line;
  line.points = {0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double chord = distance(points[line.points.back()], points[i]);
    if (chord > 0.0 && chord >= kShortChord * longest) line.points.push_back(i);
  }
  if (line.points.size() > 1) line.points.back() = points.size() - 1;  // the end is kept always
  line.begin = {0.0};
  for (std::size_t j = 1; j < line.points.size(); ++j) {
    line.begin.push_back(line.begin.back() +
                         distance(points[line.points[j - 1]], points[line.points[j]]));
  }
  return line;
}

/// Shape (chords + 1); none at the two ends.
std::vector<Turn> turns_of(const Polyline& line, const path::Interpolation& path) {
  const double rounding = rounding_of(path);
  std::vector<Turn> turns(line.points.size());
  for (std::size_t j = 1; j + 1 < line.points.size(); ++j) {
    const path::Vec3& here = path.points[line.points[j]];
    const path::Vec3 in = here - path.points[line.points[j - 1]];
    const path::Vec3 out = path.points[line.points[j + 1]] - here;
    const double a = line.length(j - 1);
    const double b = line.length(j);
    const double cross = in.x * out.y - in.y * out.x;
    turns[j].at = line.begin[j] + (b - a) / 3.0;
    if (std::abs(cross) <= 2.0 * rounding * (a + b)) continue;
    turns[j].angle = std::atan2(cross, in.x * out.x + in.y * out.y);
    turns[j].curvature = 4.0 * std::sin(0.5 * turns[j].angle) / (a + b);
  }
  return turns;
}

/// Curvature is rounded to a multiple of this [1/mm]: on a circle it is then the same in almost
/// every period, and so is what is prepared for its angles.
constexpr double kCurvatureStep = 0x1p-32;

/// Curvature at the middle of a chord.
double curvature_of(const Polyline& line, const std::vector<Turn>& turns, std::size_t chord) {
  if (line.chords() < 2) return 0.0;
  if (chord == 0) return turns[1].curvature;
  const Turn& before = turns[chord];
  if (chord + 1 == line.chords()) return before.curvature;
  const Turn& after = turns[chord + 1];
  const double part = (line.middle(chord) - before.at) / (after.at - before.at);
  return before.curvature + part * (after.curvature - before.curvature);
}

/// Turning per length beyond the end, if the path went on as it ends [rad/mm]: the lesser of the
/// last two, for a corner does not go on.
double turning_beyond(const Polyline& line, const std::vector<Turn>& turns) {
  const std::size_t count = line.chords();
  if (count < 2) return 0.0;
  const double last = std::abs(turns[count - 1].curvature);
  return count < 3 ? last : std::min(last, std::abs(turns[count - 2].curvature));
}

}  // namespace

std::vector<Bend> bends_of(const path::Interpolation& path, double reach) {
  std::vector<Bend> bends(path.points.size() - 1);
  const Polyline line = without_short_chords(path.points);
  if (line.chords() == 0) return bends;
  const std::vector<Turn> turns = turns_of(line, path);
  std::vector<double> turning(turns.size(), 0.0);  // up to each point, itself included [rad]
  for (std::size_t j = 1; j < turns.size(); ++j) {
    turning[j] = turning[j - 1] + std::abs(turns[j].angle);
  }
  const double beyond = turning_beyond(line, turns);
  std::size_t furthest = 0;
  for (std::size_t chord = 0; chord < line.chords(); ++chord) {
    const double limit = line.middle(chord) + reach;
    while (furthest + 1 < turns.size() && line.begin[furthest + 1] <= limit) ++furthest;
    const std::size_t last = std::max(furthest, chord);
    const double past_end = std::max(0.0, limit - line.middle(line.chords() - 1));
    const double steps = curvature_of(line, turns, chord) / kCurvatureStep;
    const Bend bend{std::nearbyint(steps) * kCurvatureStep,
                    turning[last] - turning[chord] + beyond * past_end};
    std::fill(bends.begin() + line.points[chord], bends.begin() + line.points[chord + 1], bend);
  }
  return bends;
}

}  // namespace millstudy::process
