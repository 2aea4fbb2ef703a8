// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "force/edge_sweep.h"
#include "force/lanes_math.h"
#include "force/prepared_edges.h"
#include "force/reach_stretch.h"
#include "force/reach_walk.h"

namespace millstudy::force {
namespace {

/// How far a flute stands out over another at the points of a piece: turning times exp(i psi), of
/// which it is the real part, psi the lag angle of the one.
class RadiusAhead {
 public:
  RadiusAhead(const CuttingEdges& edges, int flute, int other, const EdgePiece& piece)
      : envelope_(edges.envelope()),
        own_(edges.cutter().runout, edges.flutes()[flute].position),
        other_(edges.cutter().runout, edges.flutes()[other].position),
        own_tangent_(edges.flutes()[flute].helix_tangent),
        other_tangent_(edges.flutes()[other].helix_tangent),
        bottom_(envelope_.lag(piece.bottom)),
        range_(envelope_.lag(piece.top) - bottom_) {}

  double at(double z, double lag) const {
    return own_.at(z, direction(own_tangent_ * lag)) -
           other_.at(z, direction(other_tangent_ * lag));
  }
  double at(double part) const {
    const double lag = lag_of(part);
    return at(envelope_.height_at_lag(lag), lag);
  }

  std::complex<double> turning(double part) const {
    const double lag = lag_of(part), z = envelope_.height_at_lag(lag);
    return vector(own_, z) -
           vector(other_, z) * std::polar(1.0, (other_tangent_ - own_tangent_) * lag);
  }

 private:
  double lag_of(double part) const { return bottom_ + part * range_; }
  static std::array<double, 2> direction(double psi) { return {std::cos(psi), std::sin(psi)}; }
  static std::complex<double> vector(const RadialRunout& runout, double z) {
    return {runout.at(z, {1.0, 0.0}), -runout.at(z, {0.0, 1.0})};
  }

  const cutter::Envelope& envelope_;
  RadialRunout own_;
  RadialRunout other_;
  double own_tangent_;
  double other_tangent_;
  double bottom_;  ///< lag per tangent [rad]
  double range_;
};

}  // namespace

ReachEdge::ReachEdge(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece)
    : rows_(rows),
      flute_(flute),
      position_(edges.flutes()[flute].position),
      piece_(edges.envelope(), edges.flutes()[flute].helix_tangent, piece) {
  constexpr int kLooks = 64;
  constexpr double kNegligible = 3e-15;  // of the largest
  const int count = static_cast<int>(edges.flutes().size());
  const double lag1 = edges.envelope().lag(piece.bottom), lag2 = edges.envelope().lag(piece.top);
  double steepest = 0.0;
  for (const cutter::Flute& other : edges.flutes()) {
    steepest = std::max(steepest, std::abs(other.helix_tangent));
  }
  longest_lag_ = steepest * (lag2 - lag1);
  std::vector<std::array<std::complex<double>, kLooks + 1>> radius;
  for (int m = 1; m <= count; ++m) {
    const RadiusAhead ahead(edges, flute, (flute + m) % count, piece);
    const auto ratio_at = [&](double lag) {
      return m == count ? static_cast<double>(count) : edges.pitch_ratio(flute, lag, m);
    };
    radius.emplace_back();
    double size = 0.0;
    for (int i = 0; i <= kLooks; ++i) {
      radius.back()[i] = ahead.turning(static_cast<double>(i) / kLooks);
      size = std::max(size, std::abs(radius.back()[i]));
    }
    const double per_size = size > 0.0 ? 1.0 / size : 0.0;
    reaches_.push_back(
        {ratio_at(lag1), ratio_at(lag2) - ratio_at(lag1),
         PartSeries([&](double part) { return ahead.at(part); }, kNegligible * size), size,
         moment_series(edges, rows, flute, piece, [&](const EdgeNode& node) -> NodeLoads {
           const double area = node.sin_kappa * node.width;
           return {ratio_at(node.lag) * area, per_size * ahead.at(node.z, node.lag) * area,
                   node.length};
         })});
  }
  const auto look_at = [&](double ratio, double slope, const auto& radius_at) {
    Apart apart = {{std::abs(ratio), std::abs(ratio + slope)},
                   std::abs(slope) * piece_.per_lag,
                   {std::abs(radius_at(0)), 0.0},
                   0.0};
    double step = 0.0;
    for (int i = 0; i <= kLooks; ++i) {
      const double size = std::abs(radius_at(i));
      apart.radius = {std::min(apart.radius[0], size), std::max(apart.radius[1], size)};
      if (i > 0) step = std::max(step, std::abs(radius_at(i) - radius_at(i - 1)));
    }
    // What goes on between the looks: they turn by a small angle from one to the next.
    constexpr double kMore = 1.1;
    apart.radius = {std::max(0.0, apart.radius[0] - kMore * step), apart.radius[1] + kMore * step};
    apart.radius_speed = kMore * step * kLooks * piece_.per_lag;
    if (apart.ratio[0] > apart.ratio[1]) std::swap(apart.ratio[0], apart.ratio[1]);
    if (ratio * (ratio + slope) < 0.0) apart.ratio[0] = 0.0;
    apart_.push_back(apart);
  };
  for (int m = 0; m < count; ++m) {
    const Reach& one = reaches_[m];
    look_at(one.ratio, one.ratio_slope, [&](int i) { return radius[m][i]; });
    for (int n = 0; n < m; ++n) {
      const Reach& two = reaches_[n];
      look_at(one.ratio - two.ratio, one.ratio_slope - two.ratio_slope,
              [&](int i) { return radius[m][i] - radius[n][i]; });
    }
  }
}

/// As a fraction of how fast the immersion angle turns; 1 if the chip comes too close to none for
/// that to tell.
double ReachEdge::fastest_turn(double feed) const {
  double fastest = 0.0;
  for (const Apart& apart : apart_) {
    const double distance =
        std::max(feed * apart.ratio[0] - apart.radius[1], apart.radius[0] - feed * apart.ratio[1]);
    const double speed = apart.radius_speed + feed * apart.ratio_speed;
    fastest = std::max(fastest, speed < distance ? speed / distance : speed > 0.0 ? 1.0 : 0.0);
  }
  return fastest;
}

/// A place with what does not depend on the spindle angle.
struct ReachEdge::Node : Place {
  std::vector<double> ahead;  ///< by reach [mm]
};

class ReachEdge::Sweep : public EdgeSweep<Sweep, Node, ReachWalk> {
 public:
  Sweep(const LaggingPiece& piece, const std::vector<ReachStretch>& stretches,
        const Cells<Node>& cells, const ReachWalk& walk, const Angle& entry, const Angle& exit,
        Noted<ReachWalk>& noted)
      : EdgeSweep(piece, cells, walk, entry, exit, noted),
        stretches_(stretches),
        entry_(entry),
        exit_(exit) {}

 private:
  friend EdgeSweep;
  using At = LowestAt<ReachPoint>;

  void begin(const Spindle&) const {}

  At lowest_at_node(const Spindle& spindle, const Node& node) const {
    const ReachPoint point = {Lanes{} + node.part, spindle.at(node.shift)};
    return {point, walk_.lowest_at(point, node.ahead)};
  }
  At lowest_at_limit(const Spindle& spindle, bool is_entry) const {
    const Angle& limit = is_entry ? entry_ : exit_;
    const ReachPoint point = {piece_.part_below(Lanes{} + limit.value, spindle.lower_angle),
                              lanes_of(limit)};
    return {point, walk_.lowest_at(point)};
  }

  static ReachChip chip_at(const At& end) {
    return select(end.chip.value >= 0.0, ReachWalk::chip_of(end.chip.which), ReachChip{});
  }

  [[gnu::always_inline]] ForceLanes up_to_limit(bool, const At& end) const {
    return sum(chip_at(end), [&](const ReachStretch& stretch) {
      return stretch.up_to(end.point.part, end.point.phi);
    });
  }
  [[gnu::always_inline]] ForceLanes whole(const At& end) const {
    return sum(chip_at(end),
               [&](const ReachStretch& stretch) { return stretch.whole(end.point.phi); });
  }

  void add_noted(SamplingRun& run, int last) const {
    add_changes(run, noted_.of_teeth, last, &ReachStretch::chip_up_to);
    add_changes(run, noted_.of_chip, last, &ReachStretch::up_to);
  }

  template <class UpTo>
  void add_changes(SamplingRun& run, const std::vector<Noted<ReachWalk>::Change>& changes, int last,
                   const UpTo& up_to) const {
    for (const auto& change : changes) {
      add_vector(run, change.n, last, sum(change.chip, [&](const ReachStretch& stretch) {
                   return (stretch.*up_to)(change.point.part, change.point.phi);
                 }));
    }
  }

  /// Of the forces under each reach.
  template <class ForceOf>
  [[gnu::always_inline]] ForceLanes sum(const ReachChip& chip, const ForceOf& force_of) const {
    ForceLanes sum;
    for (std::size_t m = 0; m < stretches_.size(); ++m) {
      const Lanes times = chip.times_of(static_cast<int>(m));
      if (!any(times != 0.0)) continue;
      const ForceLanes force = force_of(stretches_[m]);
      sum += {times * force.x, times * force.y, times * force.z, times * force.torque};
    }
    return sum;
  }

  const std::vector<ReachStretch>& stretches_;
  const Angle& entry_;
  const Angle& exit_;
};

void ReachEdge::add_to(SamplingRun& run, const Coefficients& k, const Feed& feed,
                       std::span<const Arc> arcs) const {
  const Angle axes(std::remainder(feed.direction, core::kTurn) +
                   (rows_ == Rows::moments ? 0.5 * core::kPi : 0.0));
  std::vector<ReachLine> lines;
  std::vector<ReachStretch> stretches;
  for (const Reach& reach : reaches_) {
    lines.push_back(
        {reach.ahead, feed.per_tooth * reach.ratio, feed.per_tooth * reach.ratio_slope});
    stretches.emplace_back(reach.moments, reach.size, k, feed.per_tooth, axes.cosine, axes.sine);
  }
  const double turn = fastest_turn(feed.per_tooth);
  const Cells<Node> cells(piece_, turn, [&](const Place& place) {
    Node node = {place, {}};
    for (const ReachLine& line : lines) {
      node.ahead.push_back(line.ahead.at(Lanes{} + place.part).value[0]);
    }
    return node;
  });
  constexpr double kLook = 0.5;  // [rad]: of 1 rad none of 100 000 random cutters was wrong
  const int looks = turn < 1.0 ? 0 : 1 + static_cast<int>(longest_lag_ / cells.count() / kLook);
  const ReachWalk walk(piece_, lines, looks, 1.0 / cells.count());
  run.begin_tooth(position_);
  Noted<ReachWalk> noted;
  for (const Arc& arc : arcs) {
    const Angle entry(arc.entry_angle), exit(arc.exit_angle);
    Sweep(piece_, stretches, cells, walk, entry, exit, noted).add_to(run);
  }
}

}  // namespace millstudy::force
