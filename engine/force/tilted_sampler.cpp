// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "force/edge_sweep.h"
#include "force/lanes_math.h"
#include "force/prepared_edges.h"
#include "force/runout_stretch.h"
#include "force/teeth_before.h"
#include "force/tilted_chip.h"
#include "force/tilted_walk.h"

namespace millstudy::force {
namespace {

[[gnu::always_inline]] inline Lanes one_where(const auto& mask) {
  return mask ? Lanes{} + 1.0 : Lanes{};
}

}  // namespace

TiltedEdge::TiltedEdge(const CuttingEdges& edges, Rows rows, const EdgePiece& piece)
    : rows_(rows),
      piece_(edges.envelope(), edges.flutes()[0].helix_tangent, piece),
      middle_(0.5 * (piece.bottom + piece.top)),
      heights_(height_series(edges.envelope(), piece)),
      series_(moment_series(edges, rows, 0, piece, 2,
                            [&](const EdgeNode& node, std::span<NodeLoads> loads) {
                              loads[0] = loads_of_feeds(edges, 0, node);
                              loads[1] = {(node.z - middle_) * loads[0].chip, 0.0, 0.0};
                            })) {}

/// A place with what does not depend on the spindle angle.
struct TiltedEdge::Node : Place {
  double height;  ///< above the middle of the piece [mm]
};

class TiltedEdge::Sweep : public EdgeSweep<Sweep, Node, TiltedWalk> {
 public:
  /// Memory that one sweep leaves to the next.
  struct Scratch {
    TiltedChips chips;
    Noted<TiltedWalk> noted;
  };

  Sweep(const TiltedEdge& edge, const RunoutStretch& stretch, const RunoutStretch& by_height,
        const Cells<Node>& cells, bool carefully, const std::vector<TiltedLineOfTip>& lines,
        const ArcLimit& entry, const ArcLimit& exit, Scratch& scratch)
      : EdgeSweep(edge.piece_, cells,
                  TiltedWalk(edge.piece_, edge.heights_, scratch.chips,
                             static_cast<int>(lines.size()), carefully),
                  entry.angle(), exit.angle(), scratch.noted),
        heights_(edge.heights_),
        stretch_(stretch),
        by_height_(by_height),
        lines_(lines),
        entry_(entry),
        exit_(exit),
        chips_(scratch.chips) {}

 private:
  friend EdgeSweep;
  using At = LowestAt<Point>;

  void begin(const Spindle& spindle) const {
    const Lanes c = spindle.cosine * spindle.pass.cosine - spindle.sine * spindle.pass.sine;
    const Lanes s = spindle.sine * spindle.pass.cosine + spindle.cosine * spindle.pass.sine;
    const auto turned = [&](const std::complex<double>& w) -> ChipLanes {
      return {c * w.real() - s * w.imag(), s * w.real() + c * w.imag()};
    };
    for (std::size_t m = 0; m < lines_.size(); ++m) {
      chips_[m] = {turned(lines_[m].turning), turned(lines_[m].per_height)};
      chips_[m].middle.q += lines_[m].feed;
    }
  }

  [[gnu::always_inline]] At lowest_at(const Point& point) const {
    return {point, walk_.lowest_at(point)};
  }
  [[gnu::always_inline]] At lowest_at_node(const Spindle& spindle, const Node& node) const {
    return lowest_at({Lanes{} + node.part, Lanes{} + node.height, spindle.at(node.shift)});
  }
  [[gnu::always_inline]] At lowest_at_limit(const Spindle& spindle, bool is_entry) const {
    const Angle& limit = (is_entry ? entry_ : exit_).angle();
    const Lanes part = piece_.part_below(Lanes{} + limit.value, spindle.lower_angle);
    return lowest_at({part, heights_.at(part).value, lanes_of(limit)});
  }

  TiltedChip chip_at(const At& end) const {
    return select(end.chip.value >= 0.0, walk_.chip_of(end.chip.which), TiltedChip{});
  }

  [[gnu::always_inline]] ForceLanes up_to_limit(bool is_entry, const At& end) const {
    const TiltedChip chip = chip_at(end);
    ForceLanes force = (is_entry ? entry_ : exit_)
                           .up_to(end.point.part, {chip.middle, one_where(end.chip.value >= 0.0)});
    if (any((chip.per_height.p != 0.0) | (chip.per_height.q != 0.0))) {
      force += by_height_.chip_up_to(end.point.part, end.point.phi, chip.per_height);
    }
    return force;
  }

  [[gnu::always_inline]] ForceLanes whole(const At& end) const {
    const TiltedChip chip = chip_at(end);
    ForceLanes force =
        stretch_.whole(end.point.phi, {chip.middle, one_where(end.chip.value >= 0.0)});
    return force += by_height_.chip_of_whole(end.point.phi, chip.per_height);
  }

  void add_noted(SamplingRun& run, int last) const {
    add_changes<kChipWorths>(run, noted_.of_teeth, last);
    add_changes<kWorths>(run, noted_.of_chip, last);
  }

  /// Adds the stretches up to the changes: long sums, of which the processor does two abreast.
  template <int kSums>
  void add_changes(SamplingRun& run, const std::vector<Noted<TiltedWalk>::Change>& changes,
                   int last) const {
    for (std::size_t first = 0; first < changes.size(); first += 2) {
      const std::size_t second = std::min(first + 1, changes.size() - 1);
      const std::array<Lanes, 2> parts = {changes[first].point.part, changes[second].point.part};
      const auto sums = stretch_.sums<kSums>(variables(stretch_, parts));
      const auto by_height = by_height_.sums<kChipWorths>(variables(by_height_, parts));
      for (std::size_t i = 0; i <= second - first; ++i) {
        const auto& change = changes[first + i];
        const SineAndCosine& phi = change.point.phi;
        ForceLanes force;
        if constexpr (kSums == kWorths) {
          force = RunoutStretch::force(sums[i], phi, {change.chip.middle, change.edge});
        } else {
          force = RunoutStretch::chip_force(sums[i], phi, change.chip.middle);
        }
        force += RunoutStretch::chip_force(by_height[i], phi, change.chip.per_height);
        add_vector(run, change.n, last, force);
      }
    }
  }

  static std::array<Lanes, 2> variables(const RunoutStretch& stretch,
                                        const std::array<Lanes, 2>& parts) {
    return {stretch.variable_at(parts[0]), stretch.variable_at(parts[1])};
  }

  const PartSeries& heights_;
  const RunoutStretch& stretch_;
  const RunoutStretch& by_height_;
  const std::vector<TiltedLineOfTip>& lines_;
  const ArcLimit& entry_;
  const ArcLimit& exit_;
  TiltedChips& chips_;
};

namespace {

/// The reaches of a tooth.
std::vector<TiltedLineOfTip> lines_of(const CuttingEdges& edges, int flute, const Feed& feed,
                                      double middle) {
  const TeethBefore before(edges, flute, feed);
  const cutter::Runout& runout = edges.cutter().runout;
  const Angle leans(edges.flutes()[flute].position - runout.tilt_angle);
  std::vector<TiltedLineOfTip> lines;
  for (int m = 0; m < before.count(); ++m) {
    const LineOfTip at_tip = before.of_tip(m);
    const std::complex<double> per_height = before.ahead(m, std::tan(runout.tilt), leans);
    lines.push_back({{at_tip.turning + middle * per_height, at_tip.feed}, per_height});
  }
  return lines;
}

/// The largest slope of heights [mm].
double steepest(const PartSeries& heights) {
  return std::max(std::abs(heights.at(Lanes{}).slope[0]),
                  std::abs(heights.at(Lanes{} + 1.0).slope[0]));
}

/// How fast the phase of a chip turns at most, or of the difference of two, over the immersion
/// angle: Z = P + i Q goes along a line, and around the origin by no more than its speed over its
/// distance from there. 1 if it comes too close for that to tell.
double fastest_turn(const LaggingPiece& piece, const PartSeries& heights,
                    const std::vector<TiltedLineOfTip>& lines) {
  if (piece.lag < kAngleSnap) return 0.0;  // of one immersion angle: linear in height, zero once
  const double low = heights.at(Lanes{}).value[0], high = heights.at(Lanes{} + 1.0).value[0];
  double fastest = 0.0;
  const auto look_at = [&](const TiltedLineOfTip& a, const TiltedLineOfTip& b) {
    const std::complex<double> middle = a.turning - b.turning;
    const std::complex<double> per_height = a.per_height - b.per_height;
    const double speed = std::abs(per_height) * steepest(heights) * piece.per_lag;
    const double distance =
        std::abs(a.feed - b.feed) -
        std::max(std::abs(middle + low * per_height), std::abs(middle + high * per_height));
    fastest = std::max(fastest, speed < distance ? speed / distance : speed > 0.0 ? 1.0 : 0.0);
  };
  const TiltedLineOfTip no_chip{};
  for (std::size_t m = 0; m < lines.size(); ++m) {
    look_at(lines[m], no_chip);
    for (std::size_t n = 0; n < m; ++n) look_at(lines[m], lines[n]);
  }
  return fastest;
}

}  // namespace

void TiltedEdge::add_to(SamplingRun& run, const CuttingEdges& edges, int first, int last,
                        const Coefficients& k, const Feed& feed, std::span<const Arc> arcs) const {
  const Angle axes(std::remainder(feed.direction, core::kTurn) +
                   (rows_ == Rows::moments ? 0.5 * core::kPi : 0.0));
  const RunoutStretch stretch(series_[0], k, axes.cosine, axes.sine);
  const RunoutStretch by_height(series_[1], k, axes.cosine, axes.sine);
  const std::vector<ArcLimit> limits =
      limits_of(arcs, stretch, feed.per_tooth * static_cast<double>(edges.flutes().size()));
  Sweep::Scratch scratch;
  for (int flute = first; flute <= last; ++flute) {
    const std::vector<TiltedLineOfTip> lines = lines_of(edges, flute, feed, middle_);
    const double turn = fastest_turn(piece_, heights_, lines);
    const Cells<Node> cells(piece_, turn, [&](const Place& place) -> Node {
      return {place, heights_.at(Lanes{} + place.part).value[0]};
    });
    run.begin_tooth(Angle(edges.flutes()[flute].position));
    for (std::size_t i = 0; i < limits.size(); i += 2) {
      Sweep(*this, stretch, by_height, cells, turn >= 1.0, lines, limits[i], limits[i + 1], scratch)
          .add_to(run);
    }
  }
}

}  // namespace millstudy::force
