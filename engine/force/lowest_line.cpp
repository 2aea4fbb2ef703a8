// SPDX-License-Identifier: MIT
#include "force/lowest_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millstudy::force {
namespace {

ChipLine difference(const ChipLine& a, const ChipLine& b) {
  return {0.0, 0.0, 0.0, a.a - b.a, a.b - b.b};
}

/// Between two points less than half a turn apart.
class Walk {
 public:
  Walk(const cutter::Envelope& envelope, double helix_tangent, std::span<const ChipLine> lines,
       const EdgePoint& low, const EdgePoint& high, std::vector<LineStretch>& out)
      : envelope_(envelope),
        tangent_(helix_tangent),
        lines_(lines),
        low_(low),
        high_(high),
        out_(out) {}

  void go() {
    const int last = lowest_at(high_);
    int now = lowest_at(low_);
    EdgePoint from = low_;
    for (std::size_t step = 1; now != last && step < lines_.size(); ++step) {
      // Only a line that ends below this one crosses it; the first to do so is next.
      int next = last;
      double first = std::numeric_limits<double>::infinity();
      for (std::size_t m = 0; m < lines_.size(); ++m) {
        const ChipLine apart = difference(lines_[m], lines_[now]);
        if (!(apart.at(high_.direction) < 0.0)) continue;
        const double turn = turn_to_fall(apart);
        if (turn < first) first = turn, next = static_cast<int>(m);
      }
      if (std::isinf(first)) break;  // of equal lines either serves
      const EdgePoint to = edge_point(envelope_, tangent_, std::max(from.z, height(first)));
      keep_positive(from, to, now);
      from = to;
      now = next;
    }
    keep_positive(from, high_, now);
  }

 private:
  int lowest_at(const EdgePoint& point) const {
    const auto less = [&](const ChipLine& a, const ChipLine& b) {
      return a.at(point.direction) < b.at(point.direction);
    };
    return static_cast<int>(std::min_element(lines_.begin(), lines_.end(), less) - lines_.begin());
  }

  /// From the lower point up to where a line goes from plus to minus [rad]. Which of its two zeros
  /// that is does not depend on how its values at the ends were rounded.
  double turn_to_fall(const ChipLine& line) const {
    const double c = tangent_ < 0.0 ? line.b : -line.b;
    const double s = tangent_ < 0.0 ? -line.a : line.a;
    const std::array<double, 2>& at = low_.direction;
    return std::abs(std::atan2(at[0] * s - at[1] * c, at[0] * c + at[1] * s));
  }
  double turn_to_rise(const ChipLine& line) const {
    return turn_to_fall(difference(ChipLine{}, line));
  }

  double height(double turn) const {
    const double lag = low_.lag + turn / std::abs(tangent_);
    return std::clamp(envelope_.height_at_lag(lag), low_.z, high_.z);
  }

  void keep_positive(const EdgePoint& from, const EdgePoint& to, int m) {
    const ChipLine& line = lines_[m];
    const double below = line.at(from.direction), above = line.at(to.direction);
    if (below <= 0.0 && above <= 0.0) return;
    const double z1 = below < 0.0 ? std::max(from.z, height(turn_to_rise(line))) : from.z;
    const double z2 = above < 0.0 ? std::min(to.z, height(turn_to_fall(line))) : to.z;
    if (z1 < z2) out_.push_back({{z1, z2}, m});
  }

  const cutter::Envelope& envelope_;
  double tangent_;
  std::span<const ChipLine> lines_;
  const EdgePoint& low_;
  const EdgePoint& high_;
  std::vector<LineStretch>& out_;
};

}  // namespace

void find_lowest(const cutter::Envelope& envelope, double helix_tangent,
                 std::span<const ChipLine> lines, const EdgePoint& low, const EdgePoint& high,
                 std::vector<LineStretch>& out) {
  out.clear();
  if (lines.size() == 1) {
    out.push_back({{low.z, high.z}, 0});
    return;
  }
  // Over half a turn, as from entry to exit of a slot, a line may be zero at both ends.
  constexpr double kAtOnce = 2.5;
  const double turn = std::abs(helix_tangent) * (high.lag - low.lag);
  const int parts = 1 + static_cast<int>(turn / kAtOnce);
  EdgePoint from = low;
  for (int i = 1; i <= parts; ++i) {
    const double lag = low.lag + (high.lag - low.lag) * i / parts;
    const EdgePoint to = i == parts
                             ? high
                             : edge_point(envelope, helix_tangent,
                                          std::clamp(envelope.height_at_lag(lag), from.z, high.z));
    if (from.z < to.z) Walk(envelope, helix_tangent, lines, from, to, out).go();
    from = to;
  }
}

}  // namespace millstudy::force
