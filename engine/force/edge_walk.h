// SPDX-License-Identifier: MIT
#pragma once

#include "force/lagging_piece.h"
#include "force/lanes_math.h"

/// Where, up an edge, the chip of one tooth gives way to that of another, where no formula tells: a
/// vector of spindle angles at a time.
namespace millstudy::force {

/// A part of a piece, small enough that a chip whose phase goes one way is zero once.
struct Cell {
  SineAndCosine middle;  ///< of the immersion angle there
  double part;           ///< of the piece's lag that is below the middle

  /// The immersion angle of a point with a part of the lag below it.
  SineAndCosine phi_at(const LaggingPiece& piece, const Lanes& below) const {
    const SineAndCosine ahead = sine_and_cosine(piece.hand * piece.lag * (below - part));
    return {middle.sine * ahead.cosine - middle.cosine * ahead.sine,
            middle.cosine * ahead.cosine + middle.sine * ahead.sine};
  }
};

/// The smallest of the chips at a point of the edge.
struct Lowest {
  Lanes which;
  Lanes value;  ///< over sin(kappa) [mm]
};

template <class Mask>
[[gnu::always_inline]] inline Lowest select(const Mask& mask, const Lowest& a, const Lowest& b) {
  return {mask ? a.which : b.which, mask ? a.value : b.value};
}

template <class Point>
struct LowestAt {
  Point point;
  Lowest chip;
};

template <class Mask, class Point>
[[gnu::always_inline]] inline LowestAt<Point> select(const Mask& mask, const LowestAt<Point>& a,
                                                     const LowestAt<Point>& b) {
  return {select(mask, a.point, b.point), select(mask, a.chip, b.chip)};
}

/// A chip, or a difference of chips, at a point.
template <class Point>
struct Seen {
  Point point;
  Lanes value;
  Lanes slope;  ///< over the part
};

template <class Mask, class Point>
[[gnu::always_inline]] inline Seen<Point> select(const Mask& mask, const Seen<Point>& a,
                                                 const Seen<Point>& b) {
  return {select(mask, a.point, b.point), mask ? a.value : b.value, mask ? a.slope : b.slope};
}

/// Finds the changes between two points of a cell, within 1e-12 of the piece where one tooth takes
/// over from another, and to rounding where the chip begins or ends.
///
/// @tparam Edge  derives from this and says what the chips are:
///   Point              of the edge, of which `part` is a member
///   Chip               of one tooth, or what it is more than that of another; without value: none
///   count()            teeth before
///   chip_of(which), less(which, other), times(chip, factor)
///   value(chip, point)
///   see(cell, chip, part)  as Seen
///   lowest_at(point)
///   first_to_cross(from, to)  a guess which of those smaller at the upper point was so first
///   carefully()        true if a chip that is the smallest at two points need not be so between;
///                      never so if not kMayHide
///   find_hidden(cell, from, to)  then takes `to` down to where it is not, and says in which lanes
template <class Edge>
class EdgeWalk {
 public:
  /// Goes from one point of a cell up to another and calls change(point, chip, edge) for each
  /// change: the chip below less that above, and what there is of the edge forces below less above.
  /// @return the chip at the upper point
  template <class Point, class Change>
  [[gnu::noinline]] Lowest go(const Cell& cell, LowestAt<Point> from, const LowestAt<Point>& last,
                              const Change& change) const {
    using Chip = typename Edge::Chip;
    const int count = edge().count();
    const int most = edge().carefully() ? 8 * count + 8 : count;  // mostly no chip comes back
    for (int step = 0; step <= most; ++step) {
      LowestAt<Point> to = last;
      auto stops = to.chip.which != from.chip.which;
      find_crossing(cell, from, stops, to);
      if constexpr (Edge::kMayHide) {
        for (int look = 0; edge().carefully() && look < most; ++look) {
          const auto hides = edge().find_hidden(cell, from, to);
          if (!any(hides)) break;
          stops |= hides;
          find_crossing(cell, from, hides & (to.chip.which != from.chip.which), to);
        }
      }
      const auto is_chip = from.chip.value >= 0.0, stays = to.chip.value >= 0.0;
      const auto turns = is_chip != stays;
      if (any(turns)) {
        const Lanes sign = turns ? (is_chip ? Lanes{} + 1.0 : Lanes{} - 1.0) : Lanes{};
        const Chip chip = edge().chip_of(from.chip.which);
        const Point at = root(cell, edge().times(chip, -sign), from.point, to.point, turns, kEnd);
        change(at, edge().times(chip, sign), sign);
      }
      const auto goes_on = stays & (to.chip.which != from.chip.which);
      if (any(goes_on)) {
        const Chip less = edge().less(from.chip.which, to.chip.which);
        change(to.point, select(goes_on, less, Chip{}), Lanes{});
      }
      from = to;
      if (!any(stops)) break;
    }
    return from.chip;
  }

 protected:
  static constexpr double kEqual = 1e-15;  // [mm]: of chips so close either serves

 private:
  const Edge& edge() const { return static_cast<const Edge&>(*this); }

  /// Takes `to`, where another chip is smaller, down to where the first of the others crosses.
  template <class Mask, class Point>
  [[gnu::always_inline]] void find_crossing(const Cell& cell, const LowestAt<Point>& from,
                                            Mask counts, LowestAt<Point>& to) const {
    if (!any(counts)) return;
    const auto chip = edge().chip_of(from.chip.which);
    to.chip.which = counts ? edge().first_to_cross(from, to) : to.chip.which;
    for (int look = 0; look < edge().count() && any(counts); ++look) {
      const auto less = edge().less(from.chip.which, to.chip.which);
      const Point at = root(cell, less, from.point, to.point, counts, kCrossing);
      const Lowest found = edge().lowest_at(at);
      const Lanes value = edge().value(chip, at);
      const auto other = counts & (found.value < value - kEqual) & (found.which != to.chip.which) &
                         (found.which != from.chip.which);
      to.point = select(counts, at, to.point);
      to.chip.which = other ? found.which : to.chip.which;
      to.chip.value = counts ? value : to.chip.value;
      counts = other;
    }
  }

  /// Where a chip is zero between points at the upper one of which it is positive, at the lower one
  /// not, in the lanes that count. Rounding may have it otherwise: then it is at that end.
  /// @param tolerance  of the part, for the last step of Newton's method
  template <class Mask, class Chip, class Point>
  [[gnu::always_inline]] Point root(const Cell& cell, const Chip& chip, const Point& a,
                                    const Point& b, const Mask& counts, double tolerance) const {
    const Lanes at_a = edge().value(chip, a), at_b = edge().value(chip, b);
    Lanes low = a.part, high = b.part;
    // Never next to the ends: one may be a zero of its own, from which the chip has just fallen.
    const Lanes secant = at_a / (at_a - at_b);
    const Lanes start = secant < kFromEnds
                            ? Lanes{} + kFromEnds
                            : (secant < 1.0 - kFromEnds ? secant : Lanes{} + (1.0 - kFromEnds));
    Lanes part = low + start * (high - low);
    auto moves = counts;
    for (int step = 0;; ++step) {
      const auto here = edge().see(cell, chip, part);
      if (step == kMostSteps || !any(moves)) return here.point;
      low = here.value > 0.0 ? low : part;
      high = here.value > 0.0 ? part : high;
      const Lanes newton = part - here.value / here.slope;
      // Where it falls is next to another zero.
      const auto is_newton = (here.slope > 0.0) & (newton >= low) & (newton <= high);
      const Lanes change = (is_newton ? newton : 0.5 * (low + high)) - part;
      const Lanes small = is_newton ? Lanes{} + tolerance : Lanes{} + kRounding;
      // Each lane stops by itself: its bits do not depend on its neighbours.
      part = moves ? part + change : part;
      moves &= (change > small) | (change < -small);
    }
  }

  static constexpr int kMostSteps = 60;
  static constexpr double kRounding = 1e-16;  // of the part
  static constexpr double kFromEnds = 0.02;   // of a bracket
  // The last step of Newton's method: what it leaves is about its square. Where one tooth takes
  // over from another, that changes the force by its square again; but edge forces end at once.
  static constexpr double kCrossing = 1e-6;
  static constexpr double kEnd = 1e-13;
};

}  // namespace millstudy::force
