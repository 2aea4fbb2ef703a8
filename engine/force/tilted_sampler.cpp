// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "core/watch.h"
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
      piece_(edges, piece),
      middle_(0.5 * (piece.bottom + piece.top)),
      heights_(edges.envelope(), piece),
      series_(moment_series(edges, rows, 0, piece)),
      by_height_(moment_series(edges, rows, 0, piece, middle_)) {}

/// Parts of equal lag, within each of which a chip, or the difference of two, is zero once while
/// its phase goes one way.
struct TiltedEdge::Cells {
  /// A point of the piece, whatever the spindle angle.
  struct Fixed {
    double part;
    double height;  ///< above the middle of the piece [mm]
    Angle shift;    ///< immersion angle of the tip less that of the point
  };

  /// @param turn  fastest_turn(): below 1 the phase goes one way all along the piece
  Cells(const LaggingPiece& piece, const HeightSeries& heights, double turn)
      : carefully(turn >= 1.0) {
    constexpr double kWidest = 3.0;  // of both angles [rad], less than pi
    const int count = 1 + static_cast<int>(piece.lag * (1.0 + std::min(turn, 1.0)) / kWidest);
    const auto fixed = [&](double part) -> Fixed {
      return {part, heights.at(Lanes{} + part).value[0],
              Angle(piece.lower_shift.value + piece.hand * piece.lag * part)};
    };
    for (int k = 0; k < count; ++k) {
      nodes.push_back(fixed(static_cast<double>(k) / count));
      middles.push_back(fixed((k + 0.5) / count));
    }
    nodes.push_back(fixed(1.0));
  }
  int count() const { return static_cast<int>(middles.size()); }

  bool carefully;  ///< see TiltedWalk
  std::vector<Fixed> nodes;
  std::vector<Fixed> middles;
};

/// One tooth over one piece within one arc: a vector of spindle angles at a time.
class TiltedEdge::Sweep {
 public:
  /// Where, up the edge at the angles of a vector, the chip or the edge forces change.
  struct Change {
    int n;  ///< the first angle of the vector
    Point point;
    TiltedChip chip;  ///< that below less that above
    Lanes edge;       ///< 1 where the edge forces end there, -1 where they begin, else 0
  };
  /// Memory that one sweep leaves to the next.
  struct Scratch {
    TiltedChips chips;
    std::vector<Change> of_teeth;  ///< from the chip of one to that of another
    std::vector<Change> of_chip;   ///< where it begins or ends
  };

  Sweep(const TiltedEdge& edge, const RunoutStretch& stretch, const RunoutStretch& by_height,
        const Cells& cells, const std::vector<TiltedLineOfTip>& lines, const ArcLimit& entry,
        const ArcLimit& exit, Scratch& scratch)
      : piece_(edge.piece_),
        heights_(edge.heights_),
        stretch_(stretch),
        by_height_(by_height),
        cells_(cells),
        lines_(lines),
        walk_(piece_, heights_, static_cast<int>(lines.size()), cells.carefully),
        entry_(entry),
        exit_(exit),
        passage_(piece_, {entry.angle().value, exit.angle().value}),
        scratch_(scratch) {}

  void add_to(SamplingRun& run) const {
    run.for_each_pass(passage_.first, passage_.last, [&](const Pass& pass) {
      passage_.for_each_cut(piece_.hand, [&]<Cut cut>(double from, double to) {
        add<cut>(run, pass, run.between(pass, from, to, piece_.closed()));
      });
    });
  }

 private:
  /// A vector of spindle angles.
  struct Spindle {
    int n;  ///< index of the first
    const Pass& pass;
    Lanes cosine;
    Lanes sine;
    Lanes lower_angle;  ///< immersion angle of the lower end of the piece

    SineAndCosine at(const Angle& shift) const { return behind(pass, shift, cosine, sine); }
  };

  template <Cut cut>
  void add(SamplingRun& run, const Pass& pass, const IndexRange& indices) const {
    constexpr int kTogether = 16 * kLanes;
    const AngleTables& tables = run.tables();
    const double start = pass.offset - piece_.lower_shift.value;
    for (IndexRange part = indices; part.first < indices.last; part.first += kTogether) {
      part.last = std::min(part.first + kTogether, indices.last);
      core::keep_watch();
      scratch_.of_teeth.clear();
      scratch_.of_chip.clear();
      run.accumulate(part, [&](int n, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
        const Spindle spindle = {n, pass, load(&tables.cos1[n]), load(&tables.sin1[n]),
                                 start + tables.step * (static_cast<double>(n) + kLaneIndex)};
        find(spindle, scratch_.chips);
        const ForceLanes force = force_at<cut>(spindle);
        x = force.x, y = force.y, z = force.z, torque = force.torque;
      });
      add_changes<kChipWorths>(run, scratch_.of_teeth, part.last);
      add_changes<kWorths>(run, scratch_.of_chip, part.last);
    }
  }

  /// Adds the stretches up to the changes: long sums, of which the processor does two abreast.
  template <int kSums>
  void add_changes(SamplingRun& run, const std::vector<Change>& changes, int last) const {
    for (std::size_t first = 0; first < changes.size(); first += 2) {
      const std::size_t second = std::min(first + 1, changes.size() - 1);
      const std::array<Lanes, 2> parts = {changes[first].point.part, changes[second].point.part};
      const auto sums = stretch_.sums<kSums>(variables(stretch_, parts));
      const auto by_height = by_height_.sums<kChipWorths>(variables(by_height_, parts));
      for (std::size_t i = 0; i <= second - first; ++i) {
        const Change& change = changes[first + i];
        const SineAndCosine& phi = change.point.phi;
        ForceLanes force;
        if constexpr (kSums == kWorths) {
          force = RunoutStretch::force(sums[i], phi, {change.chip.middle, change.edge});
        } else {
          force = RunoutStretch::chip_force(sums[i], phi, change.chip.middle);
        }
        force += RunoutStretch::chip_force(by_height[i], phi, change.chip.per_height);
        run.accumulate({change.n, std::min(change.n + kLanes, last)},
                       [&](int, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
                         x = force.x, y = force.y, z = force.z, torque = force.torque;
                       });
      }
    }
  }

  static std::array<Lanes, 2> variables(const RunoutStretch& stretch,
                                        const std::array<Lanes, 2>& parts) {
    return {stretch.variable_at(parts[0]), stretch.variable_at(parts[1])};
  }

  void find(const Spindle& spindle, TiltedChips& chips) const {
    const Lanes c = spindle.cosine * spindle.pass.cosine - spindle.sine * spindle.pass.sine;
    const Lanes s = spindle.sine * spindle.pass.cosine + spindle.cosine * spindle.pass.sine;
    const auto turned = [&](const std::complex<double>& w) -> ChipLanes {
      return {c * w.real() - s * w.imag(), s * w.real() + c * w.imag()};
    };
    for (std::size_t m = 0; m < lines_.size(); ++m) {
      chips[m] = {turned(lines_[m].turning), turned(lines_[m].per_height)};
      chips[m].middle.q += lines_[m].feed;
    }
  }

  Point at_node(const Spindle& spindle, const Cells::Fixed& fixed) const {
    return {Lanes{} + fixed.part, Lanes{} + fixed.height, spindle.at(fixed.shift)};
  }

  Point at_limit(const Spindle& spindle, const ArcLimit& limit) const {
    const Lanes part = piece_.part_below(Lanes{} + limit.angle().value, spindle.lower_angle);
    return {part, heights_.at(part).value, lanes_of(limit.angle())};
  }

  [[gnu::always_inline]] ForceLanes up_to_limit(const ArcLimit& limit, const Point& point,
                                                const TiltedChip& chip, const Lanes& edge) const {
    ForceLanes force = limit.up_to(point.part, {chip.middle, edge});
    if (any((chip.per_height.p != 0.0) | (chip.per_height.q != 0.0))) {
      force += by_height_.chip_up_to(point.part, point.phi, chip.per_height);
    }
    return force;
  }

  template <Cut cut>
  [[gnu::always_inline]] ForceLanes force_at(const Spindle& spindle) const {
    const TiltedChips& chips = scratch_.chips;
    constexpr bool cut_below = cut == Cut::lower || cut == Cut::both;
    constexpr bool cut_above = cut == Cut::upper || cut == Cut::both;
    const bool right = piece_.hand > 0.0;
    const ArcLimit& upper_limit = right ? entry_ : exit_;
    const ArcLimit& lower_limit = right ? exit_ : entry_;
    const Point bottom =
        cut_below ? at_limit(spindle, lower_limit) : at_node(spindle, cells_.nodes.front());
    const Point top =
        cut_above ? at_limit(spindle, upper_limit) : at_node(spindle, cells_.nodes.back());
    Point low = bottom;
    Lowest now = walk_.lowest_at(chips, low);
    ForceLanes force;
    const auto chip_now = [&] {
      return select(now.value >= 0.0, walk_.chip_of(chips, now.which), TiltedChip{});
    };
    if (cut_below) {
      force -= up_to_limit(lower_limit, bottom, chip_now(), one_where(now.value >= 0.0));
    }
    for (int k = 0; k < cells_.count(); ++k) {
      Point high = top;
      if (k + 1 < cells_.count()) {
        high = at_node(spindle, cells_.nodes[k + 1]);
        if (cut_below) high = select(high.part > bottom.part, high, bottom);
        if (cut_above) high = select(high.part < top.part, high, top);
      }
      Lowest next = walk_.lowest_at(chips, high);
      const auto differs = (now.which != next.which) | ((now.value >= 0.0) != (next.value >= 0.0));
      if (walk_.carefully() || any(differs)) {
        const Cell cell = {spindle.at(cells_.middles[k].shift), cells_.middles[k].part};
        next = walk_.go(cell, chips, {low, now}, {high, next},
                        [&](const Point& at, const TiltedChip& chip, const Lanes& edge) {
                          std::vector<Change>& of =
                              any(edge != 0.0) ? scratch_.of_chip : scratch_.of_teeth;
                          of.push_back({spindle.n, at, chip, edge});
                        });
      }
      low = high;
      now = next;
    }
    force += cut_above ? up_to_limit(upper_limit, top, chip_now(), one_where(now.value >= 0.0))
                       : whole(top, chip_now(), one_where(now.value >= 0.0));
    return force;
  }

  [[gnu::always_inline]] ForceLanes whole(const Point& top, const TiltedChip& chip,
                                          const Lanes& edge) const {
    ForceLanes force = stretch_.whole(top.phi, {chip.middle, edge});
    return force += by_height_.chip_of_whole(top.phi, chip.per_height);
  }

  const LaggingPiece& piece_;
  const HeightSeries& heights_;
  const RunoutStretch& stretch_;
  const RunoutStretch& by_height_;
  const Cells& cells_;
  const std::vector<TiltedLineOfTip>& lines_;
  TiltedWalk walk_;
  const ArcLimit& entry_;
  const ArcLimit& exit_;
  Passage passage_;
  Scratch& scratch_;
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

/// How fast the phase of a chip turns at most, or of the difference of two, over the immersion
/// angle: Z = P + i Q goes along a line, and around the origin by no more than its speed over its
/// distance from there. 1 if it comes too close for that to tell.
double fastest_turn(const LaggingPiece& piece, const HeightSeries& heights,
                    const std::vector<TiltedLineOfTip>& lines) {
  if (piece.lag < kAngleSnap) return 0.0;  // of one immersion angle: linear in height, zero once
  const double low = heights.at(Lanes{}).value[0], high = heights.at(Lanes{} + 1.0).value[0];
  double fastest = 0.0;
  const auto look_at = [&](const TiltedLineOfTip& a, const TiltedLineOfTip& b) {
    const std::complex<double> middle = a.turning - b.turning;
    const std::complex<double> per_height = a.per_height - b.per_height;
    const double speed = std::abs(per_height) * heights.steepest() * piece.per_lag;
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
  const RunoutStretch stretch(series_, k, axes.cosine, axes.sine);
  const RunoutStretch by_height(by_height_, k, axes.cosine, axes.sine);
  const std::vector<ArcLimit> limits =
      limits_of(arcs, stretch, feed.per_tooth * static_cast<double>(edges.flutes().size()));
  Sweep::Scratch scratch;
  for (int flute = first; flute <= last; ++flute) {
    const std::vector<TiltedLineOfTip> lines = lines_of(edges, flute, feed, middle_);
    const double turn = fastest_turn(piece_, heights_, lines);
    const Cells cells(piece_, heights_, turn);
    run.begin_tooth(Angle(edges.flutes()[flute].position));
    for (std::size_t i = 0; i < limits.size(); i += 2) {
      Sweep(*this, stretch, by_height, cells, lines, limits[i], limits[i + 1], scratch).add_to(run);
    }
  }
}

}  // namespace millstudy::force
