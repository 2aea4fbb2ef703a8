// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "force/lanes_math.h"
#include "force/line_changes.h"
#include "force/prepared_edges.h"
#include "force/runout_stretch.h"
#include "force/teeth_before.h"
#include "force/tooth_integral.h"

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

/// Which end of the stretch in cut is not that of the piece, but where a limit of the arc is.
enum class Cut { none, lower, upper, both };

}  // namespace

RunoutEdge::RunoutEdge(const CuttingEdges& edges, Rows rows, const EdgePiece& piece)
    : rows_(rows),
      hand_(hand(edges.flutes()[0].helix_tangent)),
      lower_shift_(edges.flutes()[0].helix_tangent * edges.envelope().lag(piece.bottom)),
      upper_shift_(edges.flutes()[0].helix_tangent * edges.envelope().lag(piece.top)),
      lag_(lag_over(edges.flutes()[0].helix_tangent,
                    edges.envelope().lag(piece.top) - edges.envelope().lag(piece.bottom))),
      per_lag_(1.0 / std::max(lag_, 1e-300)),
      series_(moment_series(edges, rows, 0, piece)) {}

/// A limit of an arc, with what the tooth's own line, which does not turn, is worth there.
struct RunoutEdge::Limit {
  Limit(double at, const RunoutStretch& stretch, double feed_of_turn)
      : angle(at), own_feed(feed_of_turn), terms(stretch.steady_terms(angle, feed_of_turn)) {}

  Angle angle;
  double own_feed;  ///< [mm]
  SteadyTerms terms;
};

/// One tooth over one piece within one arc: a vector of spindle angles at a time.
class RunoutEdge::Sweep {
 public:
  Sweep(const RunoutEdge& edge, const RunoutStretch& stretch, const TeethBefore& before,
        const Limit& entry, const Limit& exit)
      : edge_(edge),
        stretch_(stretch),
        before_(before),
        entry_(entry),
        exit_(exit),
        closed_(edge.hand_ > 0.0 ? Closed::above : Closed::below) {
    const double lower = edge_.lower_shift_.value, upper = lower + edge_.hand_ * edge_.lag_;
    first_ = entry.angle.value + std::min(lower, upper);
    entered_ = entry.angle.value + std::max(lower, upper);
    leaving_ = exit.angle.value + std::min(lower, upper);
    last_ = exit.angle.value + std::max(lower, upper);
    if (entered_ < leaving_) find_spans();
  }

  void add_to(SamplingRun& run) const {
    run.for_each_pass(first_, last_, [&](const Pass& pass) {
      const double full = std::min(entered_, leaving_), less = std::max(entered_, leaving_);
      if (edge_.hand_ > 0.0) {
        add<Cut::upper>(run, pass, first_, full);
        add<Cut::lower>(run, pass, less, last_);
      } else {
        add<Cut::lower>(run, pass, first_, full);
        add<Cut::upper>(run, pass, less, last_);
      }
      if (spans_.empty()) add<Cut::both>(run, pass, full, less);
      for (const Span& span : spans_) {
        if (span.line == kSeveral) {
          add<Cut::none>(run, pass, span.from, span.to);
        } else if (span.line != kNone) {
          run.add(pass, run.between(pass, span.from, span.to, closed_), span.force);
        }
      }
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
    const TeethBefore::AtPoint lower(before_, edge_.lower_shift_);
    const TeethBefore::AtPoint upper(before_, edge_.upper_shift_);
    std::vector<double> bounds = {entered_, leaving_};
    const auto add_bounds = [&](const TeethBefore::AtPoint& point, double shift) {
      point.for_each_change([&](double sin_phi) {
        const double phi = std::asin(sin_phi);
        for (const double tip : {phi + shift, core::kPi - phi + shift}) {
          if (tip > entered_ && tip < leaving_) bounds.push_back(tip);
        }
      });
    };
    add_bounds(lower, edge_.lower_shift_.value);
    add_bounds(upper, edge_.upper_shift_.value);
    std::sort(bounds.begin(), bounds.end());
    for (std::size_t i = 1; i < bounds.size(); ++i) {
      const Angle middle(0.5 * (bounds[i - 1] + bounds[i]));
      const auto sine_at = [&](const Angle& shift) {
        return middle.sine * shift.cosine - middle.cosine * shift.sine;
      };
      const int line = line_at(lower.smallest_at(sine_at(edge_.lower_shift_)),
                               upper.smallest_at(sine_at(edge_.upper_shift_)));
      if (!spans_.empty() && spans_.back().line == line) {
        spans_.back().to = bounds[i];
      } else {
        spans_.push_back({bounds[i - 1], bounds[i], line, {}});
        if (line >= 0)
          spans_.back().force = stretch_.whole(edge_.upper_shift_, before_.of_tip(line));
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
    const IndexRange indices = run.between(pass, from, to, closed_);
    if (indices.first >= indices.last) return;
    const AngleTables& tables = run.tables();
    const double start = pass.offset - edge_.lower_shift_.value;
    const auto lower_angle_at = [&](int n) -> Lanes {
      return start + tables.step * (static_cast<double>(n) + kLaneIndex);
    };
    std::array<ChipLanes, kMostFlutes> chips;
    Changes changes;
    const int together = kLanes * Crossings::vectors(before_.count());
    for (IndexRange part = indices; part.first < indices.last; part.first += together) {
      part.last = std::min(part.first + together, indices.last);
      changes.of_teeth.count = changes.of_chip.count = 0;
      run.accumulate(part, [&](int n, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
        const Lanes c1 = load(&tables.cos1[n]), s1 = load(&tables.sin1[n]);
        before_.find(c1, s1, chips.data());
        const Place place = {n, lower_angle_at(n), at_end(pass, edge_.lower_shift_, c1, s1),
                             at_end(pass, edge_.upper_shift_, c1, s1)};
        const ForceLanes force = force_at<cut>(chips.data(), place, changes);
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
      const Lanes below = part_below(crossings.line(i).zero(), lower_angle_at(crossings.first[i]));
      variables[i] = stretch_.variable_at(below);
    }
    variables[crossings.count] = Lanes{};
    for (int first = 0; first < crossings.count; first += 2) {
      const auto sums = stretch_.zero_sums<kSums>({variables[first], variables[first + 1]});
      for (int i = first; i < std::min(first + 2, crossings.count); ++i) {
        const ForceLanes force = stretch_.up_to_zero(crossings.line(i), sums[i - first]);
        const int n = crossings.first[i];
        run.accumulate({n, std::min(n + kLanes, last)},
                       [&](int, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
                         x = force.x, y = force.y, z = force.z, torque = force.torque;
                       });
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

  [[gnu::always_inline]] static SineAndCosine at_end(const Pass& pass, const Angle& shift,
                                                     const Lanes& c1, const Lanes& s1) {
    const double c = pass.cosine * shift.cosine + pass.sine * shift.sine;
    const double s = pass.sine * shift.cosine - pass.cosine * shift.sine;
    return {c1 * s + s1 * c, c1 * c - s1 * s};
  }

  /// Which part of the piece, its lower end at an immersion angle, is below the point at another.
  [[gnu::always_inline]] Lanes part_below(const Lanes& phi, const Lanes& lower_angle) const {
    const Lanes past = edge_.hand_ * (lower_angle - phi);
    const Lanes size = past < 0.0 ? -past : past;
    const Lanes part = (size < kAngleSnap ? Lanes{} : past) * edge_.per_lag_;
    return part > 0.0 ? (part < 1.0 ? part : Lanes{} + 1.0) : Lanes{};
  }

  /// Where the chip is that of the tooth itself, as at the limits of a slot, one series a row is
  /// enough, and none where there is no chip. Each lane has its own bits, whatever its neighbours.
  [[gnu::always_inline]] ForceLanes up_to(const Limit& limit, const Place& place,
                                          const Line& line) const {
    const Lanes part = part_below(Lanes{} + limit.angle.value, place.lower_angle);
    const auto steady = (line.edge == 0.0) | ((line.p == 0.0) & (line.q == limit.own_feed));
    ForceLanes force;
    if (any(line.edge * (steady ? Lanes{} + 1.0 : Lanes{}) != 0.0)) {
      force = select(steady, stretch_.steady_up_to(part, limit.terms), force);
      force = {force.x * line.edge, force.y * line.edge, force.z * line.edge,
               force.torque * line.edge};
    }
    if (any(~steady)) {
      force = select(steady, force, stretch_.up_to(part, lanes_of(limit.angle), line));
    }
    return force;
  }

  [[gnu::always_inline]] static SineAndCosine lanes_of(const Angle& angle) {
    return {Lanes{} + angle.sine, Lanes{} + angle.cosine};
  }

  /// The force under whichever chip is the smallest, where it is positive. Mostly one is it all
  /// over the piece; where the edge crosses from one to another that is left for later, in changes.
  template <Cut cut>
  [[gnu::always_inline]] ForceLanes force_at(const ChipLanes* chips, const Place& place,
                                             Changes& changes) const {
    constexpr bool cut_below = cut == Cut::lower || cut == Cut::both;
    constexpr bool cut_above = cut == Cut::upper || cut == Cut::both;
    const bool right = edge_.hand_ > 0.0;
    const Limit& upper_limit = right ? entry_ : exit_;
    const Limit& lower_limit = right ? exit_ : entry_;
    const SineAndCosine bottom = cut_below ? lanes_of(lower_limit.angle) : place.lower;
    const SineAndCosine top = cut_above ? lanes_of(upper_limit.angle) : place.upper;
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
      const EdgeInCut edge = {place.n, edge_.hand_, {chips, chips + before_.count()}, bottom, top};
      note_changes(edge, crosses, line, last, changes);
    }
    force += cut_above ? up_to(upper_limit, place, line) : stretch_.whole(top, line);
    return force;
  }

  const RunoutEdge& edge_;
  const RunoutStretch& stretch_;
  const TeethBefore& before_;
  const Limit& entry_;
  const Limit& exit_;
  Closed closed_;
  // Angles of the tip at which the ends of the piece pass the limits.
  double first_;
  double entered_;
  double leaving_;
  double last_;
  std::vector<Span> spans_;  ///< from entered_ to leaving_
};

void RunoutEdge::add_to(SamplingRun& run, const CuttingEdges& edges, int first, int last,
                        const Coefficients& k, const Feed& feed, std::span<const Arc> arcs) const {
  const Angle turn(std::remainder(feed.direction, core::kTurn) +
                   (rows_ == Rows::moments ? 0.5 * core::kPi : 0.0));
  const RunoutStretch stretch(series_, k, turn.cosine, turn.sine);
  const double own_feed = feed.per_tooth * static_cast<double>(edges.flutes().size());
  std::vector<Limit> limits;
  for (const Arc& arc : arcs) {
    limits.emplace_back(arc.entry_angle, stretch, own_feed);
    limits.emplace_back(arc.exit_angle, stretch, own_feed);
  }
  for (int flute = first; flute <= last; ++flute) {
    const TeethBefore before(edges, flute, feed);
    run.begin_tooth(Angle(edges.flutes()[flute].position));
    for (std::size_t i = 0; i < limits.size(); i += 2) {
      Sweep(*this, stretch, before, limits[i], limits[i + 1]).add_to(run);
    }
  }
}

}  // namespace millstudy::force
