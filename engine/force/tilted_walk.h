// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "force/chip_phase.h"
#include "force/height_series.h"
#include "force/lagging_piece.h"
#include "force/lanes_math.h"
#include "force/tilted_chip.h"

/// Where, up an edge on a tilted axis, the chip of one tooth gives way to that of another, (F28).
namespace millstudy::force {

/// A part of a piece, small enough that a chip whose phase goes one way is zero once.
struct Cell {
  SineAndCosine middle;  ///< of the immersion angle there
  double part;           ///< of the piece's lag that is below the middle
};

/// The smallest chip at a point.
struct LowestAt {
  Point point;
  Lowest chip;
};

template <class Mask>
[[gnu::always_inline]] inline LowestAt select(const Mask& mask, const LowestAt& a,
                                              const LowestAt& b) {
  return {select(mask, a.point, b.point), select(mask, a.chip, b.chip)};
}

/// Finds the changes between two points of a cell, within 1e-12 of the piece where one tooth takes
/// over from another, and to rounding where the chip begins or ends.
class TiltedWalk {
 public:
  /// @param chips     how many teeth before there are
  /// @param carefully  looks also between points at which one chip is the smallest: it may not be
  ///                   so there
  TiltedWalk(const LaggingPiece& piece, const HeightSeries& heights, int chips, bool carefully)
      : piece_(piece), heights_(heights), count_(chips), carefully_(carefully) {
    const HeightSeries::Height low = heights.at(Lanes{}), high = heights.at(Lanes{} + 1.0);
    lowest_ = low.value[0];
    per_height_ = 1.0 / (high.value[0] - lowest_);
    // The immersion angle falls with the height of a right-hand edge.
    const double per_angle = -piece.hand * piece.per_lag;
    const double at_low = low.slope[0] * per_angle, at_high = high.slope[0] * per_angle;
    rise_slope_ = (at_high - at_low) * per_height_;
    rise_ = at_low - rise_slope_ * lowest_;
  }

  bool carefully() const { return carefully_; }

  [[gnu::always_inline]] Lowest lowest_at(const TiltedChips& chips, const Point& point) const {
    Lowest best = {Lanes{}, chips[0].at(point)};
    for (int m = 1; m < count_; ++m) {
      const Lanes value = chips[m].at(point);
      best = select(value < best.value, Lowest{Lanes{} + static_cast<double>(m), value}, best);
    }
    return best;
  }

  TiltedChip chip_of(const TiltedChips& chips, const Lanes& which) const {
    TiltedChip chip = chips[0];
    for (int m = 1; m < count_; ++m) {
      chip = select(which == static_cast<double>(m), chips[m], chip);
    }
    return chip;
  }

  /// Goes from one point of a cell up to another and calls change(point, chip, edge) for each
  /// change: the chip below less that above, and what there is of the edge forces below less above.
  /// @return the chip at the upper point
  template <class Change>
  [[gnu::noinline]] Lowest go(const Cell& cell, const TiltedChips& chips, LowestAt from,
                              const LowestAt& last, const Change& change) const {
    const int most = carefully_ ? 8 * count_ + 8 : count_;  // mostly no chip comes back
    for (int step = 0; step <= most; ++step) {
      LowestAt to = last;
      const TiltedChip chip = chip_of(chips, from.chip.which);
      auto stops = to.chip.which != from.chip.which;
      find_crossing(cell, chips, chip, from, stops, to);
      for (int look = 0; carefully_ && look < most; ++look) {
        const auto hides = find_hidden(cell, chips, chip, from, to);
        if (!any(hides)) break;
        stops |= hides;
        find_crossing(cell, chips, chip, from, hides & (to.chip.which != from.chip.which), to);
      }
      const auto is_chip = from.chip.value >= 0.0, stays = to.chip.value >= 0.0;
      const auto turns = is_chip != stays;
      if (any(turns)) {
        const Lanes sign = turns ? (is_chip ? Lanes{} + 1.0 : Lanes{} - 1.0) : Lanes{};
        const Point at = root(cell, chip * -sign, from.point, to.point, turns, kEnd);
        change(at, chip * sign, sign);
      }
      const auto goes_on = stays & (to.chip.which != from.chip.which);
      if (any(goes_on)) {
        const TiltedChip less = chip - chip_of(chips, to.chip.which);
        change(to.point, select(goes_on, less, TiltedChip{}), Lanes{});
      }
      from = to;
      if (!any(stops)) break;
    }
    return from.chip;
  }

 private:
  Point at(const Cell& cell, const Lanes& part, const Lanes& height) const {
    const SineAndCosine ahead = sine_and_cosine(piece_.hand * piece_.lag * (part - cell.part));
    return {part,
            height,
            {cell.middle.sine * ahead.cosine - cell.middle.cosine * ahead.sine,
             cell.middle.cosine * ahead.cosine + cell.middle.sine * ahead.sine}};
  }

  /// Of the chips that are smaller at the upper point, probably the first to be so: the one whose
  /// chip would cross at the largest cot(phi) if none grew with height.
  [[gnu::always_inline]] Lanes first_to_cross(const TiltedChips& chips, const TiltedChip& chip,
                                              const LowestAt& from, const LowestAt& to) const {
    const Lanes height = 0.5 * (from.point.height + to.point.height);
    const ChipLanes line = chip.at_height(height);
    const Lanes value = chip.at(to.point);
    const Lanes none = Lanes{} + std::numeric_limits<double>::max();
    Lanes over = none, under = Lanes{} + 1.0, which = to.chip.which;
    for (int m = 0; m < count_; ++m) {
      const ChipLanes other = chips[m].at_height(height);
      const Lanes q = other.q - line.q, p = piece_.hand * (line.p - other.p);
      const auto sooner = (chips[m].at(to.point) < value) & (p > 0.0) & (q * under < over * p);
      over = sooner ? q : over;
      under = sooner ? p : under;
      which = sooner ? Lanes{} + static_cast<double>(m) : which;
    }
    return which;
  }

  /// Takes `to`, where another chip is smaller, down to where the first of the others crosses.
  template <class Mask>
  [[gnu::always_inline]] void find_crossing(const Cell& cell, const TiltedChips& chips,
                                            const TiltedChip& chip, const LowestAt& from,
                                            Mask counts, LowestAt& to) const {
    if (!any(counts)) return;
    to.chip.which = counts ? first_to_cross(chips, chip, from, to) : to.chip.which;
    for (int look = 0; look < count_ && any(counts); ++look) {
      const TiltedChip less = chip - chip_of(chips, to.chip.which);
      const Point at = root(cell, less, from.point, to.point, counts, kCrossing);
      const Lowest found = lowest_at(chips, at);
      const Lanes value = chip.at(at);
      const auto other = counts & (found.value < value - kEqual) & (found.which != to.chip.which) &
                         (found.which != from.chip.which);
      to.point = select(counts, at, to.point);
      to.chip.which = other ? found.which : to.chip.which;
      to.chip.value = counts ? value : to.chip.value;
      counts = other;
    }
  }

  Lanes part_at_height(const Lanes& height) const {
    Lanes part = (height - lowest_) * per_height_;
    for (int i = 0; i < 3; ++i) {  // of Newton's method
      const HeightSeries::Height at = heights_.at(part);
      part -= (at.value - height) / at.slope;
    }
    return part;
  }

  /// Takes `to` down to a place at which the chip, the smallest at both points, is not, or where
  /// its sign is not that at the lower point. Where no such is left, it is zero once at most.
  /// @return where it did
  [[gnu::always_inline]] auto find_hidden(const Cell& cell, const TiltedChips& chips,
                                          const TiltedChip& chip, const LowestAt& from,
                                          LowestAt& to) const {
    auto hides = from.point.part > to.point.part;  // nowhere
    for (int m = 0; m <= count_; ++m) {
      const bool is_other = m < count_;
      const TiltedChip more = is_other ? chips[m] - chip : chip;
      const std::array<Lanes, 3> heights =
          heights_of_turning<Lanes>({more.middle.p, more.middle.q},
                                    {more.per_height.p, more.per_height.q}, rise_, rise_slope_);
      for (const Lanes& height : heights) {
        auto here = (height > from.point.height) & (height < to.point.height);
        if (!any(here)) continue;
        const Lanes part = here ? part_at_height(height) : from.point.part;
        const Point point = at(cell, part, heights_.at(part).value);
        const Lanes value = more.at(point);
        const auto differs =
            is_other ? value < -kEqual : (value >= 0.0) != (from.chip.value >= 0.0);
        here &= differs & (point.part > from.point.part) & (point.part < to.point.part);
        if (!any(here)) continue;
        to = select(here, {point, lowest_at(chips, point)}, to);
        hides |= here;
      }
    }
    return hides;
  }

  /// Where a chip is zero between points at the upper one of which it is positive, at the lower one
  /// not, in the lanes that count. Rounding may have it otherwise: then it is at that end.
  /// @param tolerance  of the part, for the last step of Newton's method
  template <class Mask>
  [[gnu::always_inline]] Point root(const Cell& cell, const TiltedChip& chip, const Point& a,
                                    const Point& b, const Mask& counts, double tolerance) const {
    const double turn = piece_.hand * piece_.lag;
    const Lanes at_a = chip.at(a), at_b = chip.at(b);
    Lanes low = a.part, high = b.part;
    // Never next to the ends: one may be a zero of its own, from which the chip has just fallen.
    const Lanes secant = at_a / (at_a - at_b);
    const Lanes start = secant < kFromEnds
                            ? Lanes{} + kFromEnds
                            : (secant < 1.0 - kFromEnds ? secant : Lanes{} + (1.0 - kFromEnds));
    Lanes part = low + start * (high - low);
    auto moves = counts;
    for (int step = 0;; ++step) {
      const HeightSeries::Height height = heights_.at(part);
      const Point point = at(cell, part, height.value);
      if (step == kMostSteps || !any(moves)) return point;
      const ChipLanes here = chip.at_height(point.height);
      const Lanes value = here.at(point.phi);
      const Lanes slope = height.slope * chip.per_height.at(point.phi) +
                          turn * (here.p * point.phi.sine - here.q * point.phi.cosine);
      low = value > 0.0 ? low : part;
      high = value > 0.0 ? part : high;
      const Lanes newton = part - value / slope;
      // Where it falls is next to another zero.
      const auto is_newton = (slope > 0.0) & (newton >= low) & (newton <= high);
      const Lanes change = (is_newton ? newton : 0.5 * (low + high)) - part;
      const Lanes small = is_newton ? Lanes{} + tolerance : Lanes{} + kRounding;
      // Each lane stops by itself: its bits do not depend on its neighbours.
      part = moves ? part + change : part;
      moves &= (change > small) | (change < -small);
    }
  }

  static constexpr double kEqual = 1e-15;  // [mm]: of chips so close either serves
  static constexpr int kMostSteps = 60;
  static constexpr double kRounding = 1e-16;  // of the part
  static constexpr double kFromEnds = 0.02;   // of a bracket
  // The last step of Newton's method: what it leaves is about its square. Where one tooth takes
  // over from another, that changes the force by its square again; but edge forces end at once.
  static constexpr double kCrossing = 1e-6;
  static constexpr double kEnd = 1e-13;

  const LaggingPiece& piece_;
  const HeightSeries& heights_;
  int count_;
  bool carefully_;
  double lowest_;      ///< height of the lower end above the middle [mm]
  double per_height_;  ///< one over the height of the piece [1/mm]
  double rise_;        ///< height over immersion angle at the middle [mm/rad]
  double rise_slope_;  ///< and how it grows with height [1/rad]
};

}  // namespace millstudy::force
