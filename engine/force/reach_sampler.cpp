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

/// The vectors by which a flute stands out over others, of which what it stands out at a point is
/// the real part when they are turned by exp(i psi), psi the lag angle.
class VectorsAhead {
 public:
  VectorsAhead(const CuttingEdges& edges, int flute) : flutes_(edges.flutes()), flute_(flute) {
    for (const cutter::Flute& other : flutes_) {
      runout_.emplace_back(edges.cutter().runout, other.position);
    }
  }

  /// @param lag  of the envelope at z
  std::complex<double> over(int other, double z, double lag) const {
    const double behind = (flutes_[other].helix_tangent - flutes_[flute_].helix_tangent) * lag;
    return vector(flute_, z) - vector(other, z) * std::polar(1.0, behind);
  }

 private:
  std::complex<double> vector(int flute, double z) const {
    return {runout_[flute].at(z, {1.0, 0.0}), -runout_[flute].at(z, {0.0, 1.0})};
  }

  const std::vector<cutter::Flute>& flutes_;
  int flute_;
  std::vector<RadialRunout> runout_;
};

}  // namespace

ReachEdge::ReachEdge(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece)
    : rows_(rows),
      flute_(flute),
      position_(edges.flutes()[flute].position),
      piece_(edges.envelope(), edges.flutes()[flute].helix_tangent, piece) {
  const cutter::Envelope& envelope = edges.envelope();
  const int count = static_cast<int>(edges.flutes().size());
  const double tangent = edges.flutes()[flute].helix_tangent;
  const double bottom = envelope.lag(piece.bottom), range = envelope.lag(piece.top) - bottom;
  double steepest = 0.0;
  for (const cutter::Flute& other : edges.flutes()) {
    steepest = std::max(steepest, std::abs(other.helix_tangent));
  }
  longest_lag_ = steepest * range;

  constexpr int kLooks = 32;
  const VectorsAhead vectors(edges, flute);
  std::vector<std::array<std::complex<double>, kLooks + 1>> ahead(count);
  double size = 0.0;
  for (int i = 0; i <= kLooks; ++i) {
    const double lag = bottom + range * i / kLooks, z = envelope.height_at_lag(lag);
    for (int m = 0; m < count; ++m) {
      ahead[m][i] = vectors.over((flute + m + 1) % count, z, lag);
      size = std::max(size, std::abs(ahead[m][i]));
    }
  }
  // One for all: a small difference of radii has the rounding of large ones.
  size_ = size > 0.0 ? size : 1.0;

  const ChipLaw law(edges);
  std::vector<force::Reach> reaches(count);
  const auto find = [&](double z, double lag) {
    law.find(flute, {z, lag, {std::cos(tangent * lag), std::sin(tangent * lag)}}, reaches);
  };
  std::vector<MomentSeries> moments = moment_series(
      edges, rows, flute, piece, count, [&](const EdgeNode& node, std::span<NodeLoads> loads) {
        const double area = node.sin_kappa * node.width;
        find(node.z, node.lag);
        for (int m = 0; m < count; ++m) {
          loads[m] = {reaches[m].ratio * area, reaches[m].ahead / size_ * area, node.length};
        }
      });
  find(piece.bottom, bottom);
  const std::vector<force::Reach> lowest = reaches;
  find(piece.top, bottom + range);
  const std::vector<force::Reach> highest = reaches;
  constexpr double kNegligible = 3e-15;  // of the largest
  for (int m = 0; m < count; ++m) {
    const auto ahead_at = [&](double part) {
      const double lag = bottom + part * range;
      find(envelope.height_at_lag(lag), lag);
      return reaches[m].ahead;
    };
    reaches_.push_back({lowest[m].ratio, highest[m].ratio - lowest[m].ratio,
                        PartSeries(ahead_at, kNegligible * size_), std::move(moments[m])});
  }

  const auto look_at = [&](double ratio, double slope, const auto& vector_at) {
    std::array<double, 2> square = {std::norm(vector_at(0)), 0.0};
    double step = 0.0;
    for (int i = 0; i <= kLooks; ++i) {
      const double here = std::norm(vector_at(i));
      square = {std::min(square[0], here), std::max(square[1], here)};
      if (i > 0) step = std::max(step, std::norm(vector_at(i) - vector_at(i - 1)));
    }
    // What goes on between the looks: they turn by a small angle from one to the next.
    step = 1.1 * std::sqrt(step);
    const double at_bottom = std::abs(ratio), at_top = std::abs(ratio + slope);
    const bool turns = ratio * (ratio + slope) < 0.0;
    apart_.push_back({{turns ? 0.0 : std::min(at_bottom, at_top), std::max(at_bottom, at_top)},
                      std::abs(slope) * piece_.per_lag,
                      {std::max(0.0, std::sqrt(square[0]) - step), std::sqrt(square[1]) + step},
                      step * kLooks * piece_.per_lag});
  };
  for (int m = 0; m < count; ++m) {
    const Reach& one = reaches_[m];
    look_at(one.ratio, one.ratio_slope, [&](int i) { return ahead[m][i]; });
    for (int n = 0; n < m; ++n) {
      const Reach& two = reaches_[n];
      look_at(one.ratio - two.ratio, one.ratio_slope - two.ratio_slope,
              [&](int i) { return ahead[m][i] - ahead[n][i]; });
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
    stretches.emplace_back(reach.moments, size_, k, feed.per_tooth, axes.cosine, axes.sine);
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
