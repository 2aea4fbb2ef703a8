// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "force/lagging_piece.h"
#include "force/lanes_math.h"
#include "force/line_changes.h"
#include "force/prepared_edges.h"
#include "force/runout_stretch.h"
#include "force/teeth_before.h"

namespace millstudy::force {
namespace {

/// The smallest of the chips at a point of the edge.
struct Smallest {
  ChipLanes chip;
  Lanes value;
};

[[gnu::always_inline]] inline Smallest smaller(const Smallest& a, const Smallest& b) {
  const auto less = b.value < a.value;
  return {select(less, b.chip, a.chip), less ? b.value : a.value};
}

/// Of no chip where it is negative.
[[gnu::always_inline]] inline Line line_of(const Smallest& smallest) {
  const auto is_chip = smallest.value >= 0.0;
  return {select(is_chip, smallest.chip, ChipLanes{}), is_chip ? Lanes{} + 1.0 : Lanes{}};
}

}  // namespace

RunoutEdge::RunoutEdge(const CuttingEdges& edges, Rows rows, const EdgePiece& piece)
    : rows_(rows),
      piece_(edges.envelope(), edges.flutes()[0].helix_tangent, piece),
      series_(moment_series(edges, rows, 0, piece)) {}

/// One tooth over one piece within one arc: a vector of spindle angles at a time.
class RunoutEdge::Sweep {
 public:
  using Chips = std::array<ChipLanes, kMostFlutes>;

  /// @param chips  memory that one sweep leaves to the next
  Sweep(const RunoutEdge& edge, const RunoutStretch& stretch, const TeethBefore& before,
        const ArcLimit& entry, const ArcLimit& exit, Chips& chips)
      : piece_(edge.piece_),
        stretch_(stretch),
        before_(before),
        entry_(entry),
        exit_(exit),
        passage_(piece_, {entry.angle().value, exit.angle().value}),
        chips_(chips) {
    if (passage_.entered < passage_.leaving) find_spans();
  }

  void add_to(SamplingRun& run) const {
    run.for_each_pass(passage_.first, passage_.last, [&](const Pass& pass) {
      passage_.for_each_cut(piece_.hand, [&]<Cut cut>(double from, double to) {
        if (cut != Cut::none) return add<cut>(run, pass, from, to);
        for (const Span& span : spans_) {
          if (span.line == kSeveral) {
            add<cut>(run, pass, span.from, span.to);
          } else if (span.line != kNone) {
            run.add(pass, run.between(pass, span.from, span.to, piece_.closed()), span.force);
          }
        }
      });
    });
  }

 private:
  static constexpr int kSeveral = -1;
  static constexpr int kNone = -2;

  /// Angles of the tip between which the whole piece is in cut and one line is the smallest at both
  /// of its ends, and so between them: lines are linear in the cotangent of the immersion angle.
  struct Span {
    double from;
    double to;
    int line;         ///< or kSeveral, or kNone
    Harmonics force;  ///< of the one line, over the tip's angle
  };

  void find_spans() {
    const TeethBefore::AtPoint lower(before_, piece_.lower_shift);
    const TeethBefore::AtPoint upper(before_, piece_.upper_shift);
    std::vector<double> bounds = {passage_.entered, passage_.leaving};
    const auto add_bounds = [&](const TeethBefore::AtPoint& point, double shift) {
      point.for_each_change([&](double sin_phi) {
        const double phi = std::asin(sin_phi);
        for (const double tip : {phi + shift, core::kPi - phi + shift}) {
          if (tip > passage_.entered && tip < passage_.leaving) bounds.push_back(tip);
        }
      });
    };
    add_bounds(lower, piece_.lower_shift.value);
    add_bounds(upper, piece_.upper_shift.value);
    std::sort(bounds.begin(), bounds.end());
    for (std::size_t i = 1; i < bounds.size(); ++i) {
      const Angle middle(0.5 * (bounds[i - 1] + bounds[i]));
      const auto sine_at = [&](const Angle& shift) {
        return middle.sine * shift.cosine - middle.cosine * shift.sine;
      };
      const int line = line_at(lower.smallest_at(sine_at(piece_.lower_shift)),
                               upper.smallest_at(sine_at(piece_.upper_shift)));
      if (!spans_.empty() && spans_.back().line == line) {
        spans_.back().to = bounds[i];
      } else {
        spans_.push_back({bounds[i - 1], bounds[i], line, {}});
        if (line >= 0)
          spans_.back().force = stretch_.whole(piece_.upper_shift, before_.of_tip(line));
      }
    }
  }

  static int line_at(const TeethBefore::AtPoint::Chip& lower,
                     const TeethBefore::AtPoint::Chip& upper) {
    if (lower.which != upper.which || (lower.value < 0.0) != (upper.value < 0.0)) return kSeveral;
    return lower.value < 0.0 ? kNone : lower.which;
  }

  template <Cut cut>
  void add(SamplingRun& run, const Pass& pass, double from, double to) const {
    const IndexRange indices = run.between(pass, from, to, piece_.closed());
    if (indices.first >= indices.last) return;
    const AngleTables& tables = run.tables();
    const double start = pass.offset - piece_.lower_shift.value;
    const auto lower_angle_at = [&](int n) -> Lanes {
      return start + tables.step * (static_cast<double>(n) + kLaneIndex);
    };
    Changes changes;
    const int together = kLanes * Crossings::vectors(before_.count());
    for (IndexRange part = indices; part.first < indices.last; part.first += together) {
      part.last = std::min(part.first + together, indices.last);
      changes.of_teeth.count = changes.of_chip.count = 0;
      run.accumulate(part, [&](int n, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
        const Lanes c1 = load(&tables.cos1[n]), s1 = load(&tables.sin1[n]);
        before_.find(c1, s1, chips_.data());
        const Place place = {n, lower_angle_at(n), behind(pass, piece_.lower_shift, c1, s1),
                             behind(pass, piece_.upper_shift, c1, s1)};
        const ForceLanes force = force_at<cut>(chips_.data(), place, changes);
        x = force.x, y = force.y, z = force.z, torque = force.torque;
      });
      add_crossings<RunoutStretch::kChipSums>(run, changes.of_teeth, part.last, lower_angle_at);
      add_crossings<RunoutStretch::kZeroSums>(run, changes.of_chip, part.last, lower_angle_at);
    }
  }

  /// Adds the stretches up to the crossings. Each is a long chain of operations, of which the
  /// processor does several at a time where no decisions come between.
  template <int kSums, class LowerAngle>
  void add_crossings(SamplingRun& run, const Crossings& crossings, int last,
                     const LowerAngle& lower_angle_at) const {
    std::array<Lanes, Crossings::kMost + 1> variables;
    for (int i = 0; i < crossings.count; ++i) {
      const Lanes below =
          piece_.part_below(crossings.line(i).zero(), lower_angle_at(crossings.first[i]));
      variables[i] = stretch_.variable_at(below);
    }
    variables[crossings.count] = Lanes{};
    for (int first = 0; first < crossings.count; first += 2) {
      const auto sums = stretch_.zero_sums<kSums>({variables[first], variables[first + 1]});
      for (int i = first; i < std::min(first + 2, crossings.count); ++i) {
        const ForceLanes force = stretch_.up_to_zero(crossings.line(i), sums[i - first]);
        add_vector(run, crossings.first[i], last, force);
      }
    }
  }

  /// Where the piece stands.
  struct Place {
    int n;              ///< index of the first angle
    Lanes lower_angle;  ///< immersion angle of its lower end
    SineAndCosine lower;
    SineAndCosine upper;
  };

  [[gnu::always_inline]] ForceLanes up_to(const ArcLimit& limit, const Place& place,
                                          const Line& line) const {
    return limit.up_to(piece_.part_below(Lanes{} + limit.angle().value, place.lower_angle), line);
  }

  /// The force under whichever chip is the smallest, where it is positive. Mostly one is it all
  /// over the piece; where the edge crosses from one to another that is left for later, in changes.
  template <Cut cut>
  [[gnu::always_inline]] ForceLanes force_at(const ChipLanes* chips, const Place& place,
                                             Changes& changes) const {
    constexpr bool cut_below = cut == Cut::lower || cut == Cut::both;
    constexpr bool cut_above = cut == Cut::upper || cut == Cut::both;
    const bool right = piece_.hand > 0.0;
    const ArcLimit& upper_limit = right ? entry_ : exit_;
    const ArcLimit& lower_limit = right ? exit_ : entry_;
    const SineAndCosine bottom = cut_below ? lanes_of(lower_limit.angle()) : place.lower;
    const SineAndCosine top = cut_above ? lanes_of(upper_limit.angle()) : place.upper;
    Smallest below = {chips[0], chips[0].at(bottom)}, above = {chips[0], chips[0].at(top)};
    for (int m = 1; m < before_.count(); ++m) {
      below = smaller(below, {chips[m], chips[m].at(bottom)});
      above = smaller(above, {chips[m], chips[m].at(top)});
    }
    Line line = line_of(below);
    const Line last = line_of(above);
    ForceLanes force;
    if (cut_below) force -= up_to(lower_limit, place, line);
    // A smallest chip that is negative at both ends is so between them; of two one cannot know.
    const auto crosses =
        (below.chip.p != above.chip.p) | (below.chip.q != above.chip.q) | (line.edge != last.edge);
    if (any(crosses)) {
      const EdgeInCut edge = {place.n, piece_.hand, {chips, chips + before_.count()}, bottom, top};
      note_changes(edge, crosses, line, last, changes);
    }
    force += cut_above ? up_to(upper_limit, place, line) : stretch_.whole(top, line);
    return force;
  }

  const LaggingPiece& piece_;
  const RunoutStretch& stretch_;
  const TeethBefore& before_;
  const ArcLimit& entry_;
  const ArcLimit& exit_;
  Passage passage_;
  Chips& chips_;
  std::vector<Span> spans_;  ///< from where all is in cut to where it begins to leave
};

void RunoutEdge::add_to(SamplingRun& run, const CuttingEdges& edges, int first, int last,
                        const Coefficients& k, const Feed& feed, std::span<const Arc> arcs) const {
  const Angle turn(std::remainder(feed.direction, core::kTurn) +
                   (rows_ == Rows::moments ? 0.5 * core::kPi : 0.0));
  const RunoutStretch stretch(series_, k, turn.cosine, turn.sine);
  const std::vector<ArcLimit> limits =
      limits_of(arcs, stretch, feed.per_tooth * static_cast<double>(edges.flutes().size()));
  Sweep::Chips chips;
  for (int flute = first; flute <= last; ++flute) {
    const TeethBefore before(edges, flute, feed);
    run.begin_tooth(Angle(edges.flutes()[flute].position));
    for (std::size_t i = 0; i < limits.size(); i += 2) {
      Sweep(*this, stretch, before, limits[i], limits[i + 1], chips).add_to(run);
    }
  }
}

}  // namespace millstudy::force
