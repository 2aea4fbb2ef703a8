// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "force/edge_walk.h"
#include "force/lagging_piece.h"
#include "force/lanes_math.h"
#include "force/part_series.h"

/// The chips of a tooth with runout, (F33): that of one reach, over sin(kappa), is a fixed distance
/// at each height plus sin(phi) times a feed.
namespace millstudy::force {

/// A point of a piece.
struct ReachPoint {
  Lanes part;         ///< of the piece's lag that is below it, 0 .. 1
  SineAndCosine phi;  ///< of the immersion angle
};

template <class Mask>
[[gnu::always_inline]] inline ReachPoint select(const Mask& mask, const ReachPoint& a,
                                                const ReachPoint& b) {
  return {mask ? a.part : b.part,
          {mask ? a.phi.sine : b.phi.sine, mask ? a.phi.cosine : b.phi.cosine}};
}

/// One reach of a tooth, at all angles of the spindle.
struct ReachLine {
  const PartSeries& ahead;  ///< how far this tooth stands out over that one [mm]
  double feed;              ///< since that one passed, at the lower end of the piece [mm]
  double feed_slope;        ///< over the part

  Lanes at(const ReachPoint& point) const {
    return ahead.at(point.part).value + (feed + feed_slope * point.part) * point.phi.sine;
  }
};

/// A factor times the chip of one reach, or what it is more than that of another.
struct ReachChip {
  Lanes one{};
  Lanes other{};  ///< kNone: none
  Lanes factor{};

  static constexpr double kNone = -1.0;

  Lanes times_of(int m) const {
    const double which = m;
    return factor *
           ((one == which ? Lanes{} + 1.0 : Lanes{}) - (other == which ? Lanes{} + 1.0 : Lanes{}));
  }
};

template <class Mask>
[[gnu::always_inline]] inline ReachChip select(const Mask& mask, const ReachChip& a,
                                               const ReachChip& b) {
  return {mask ? a.one : b.one, mask ? a.other : b.other, mask ? a.factor : b.factor};
}

/// Finds the changes up an edge whose chips are these.
class ReachWalk : public EdgeWalk<ReachWalk> {
 public:
  using Point = ReachPoint;
  using Chip = ReachChip;
  static constexpr bool kMayHide = true;

  /// @param looks  into how many parts a cell is cut where a chip may be zero more often than its
  ///               ends tell: few enough that its slope is zero once at most in each; else 0
  /// @param width  of a cell, as a part of the piece's lag
  ReachWalk(const LaggingPiece& piece, const std::vector<ReachLine>& lines, int looks, double width)
      : piece_(piece), lines_(lines), looks_(looks), width_(width) {}

  int count() const { return static_cast<int>(lines_.size()); }
  bool carefully() const { return looks_ > 0; }

  static ReachChip chip_of(const Lanes& which) {
    return {which, Lanes{} + ReachChip::kNone, Lanes{} + 1.0};
  }
  static ReachChip less(const Lanes& which, const Lanes& other) {
    return {which, other, Lanes{} + 1.0};
  }
  static ReachChip times(const ReachChip& chip, const Lanes& factor) {
    return {chip.one, chip.other, chip.factor * factor};
  }

  [[gnu::always_inline]] Lanes value(const ReachChip& chip, const ReachPoint& point) const {
    Lanes sum{};
    for (int m = 0; m < count(); ++m) {
      const Lanes times = chip.times_of(m);
      if (any(times != 0.0)) sum += times * lines_[m].at(point);
    }
    return sum;
  }

  [[gnu::always_inline]] Seen<ReachPoint> see(const Cell& cell, const ReachChip& chip,
                                              const Lanes& part) const {
    Seen<ReachPoint> seen = {{part, cell.phi_at(piece_, part)}, Lanes{}, Lanes{}};
    const SineAndCosine& phi = seen.point.phi;
    const double turn = piece_.hand * piece_.lag;
    for (int m = 0; m < count(); ++m) {
      const Lanes times = chip.times_of(m);
      if (!any(times != 0.0)) continue;
      const ReachLine& line = lines_[m];
      const PartSeries::At ahead = line.ahead.at(part);
      const Lanes feed = line.feed + line.feed_slope * part;
      seen.value += times * (ahead.value + feed * phi.sine);
      seen.slope += times * (ahead.slope + line.feed_slope * phi.sine - turn * feed * phi.cosine);
    }
    return seen;
  }

  [[gnu::always_inline]] Lowest lowest_at(const ReachPoint& point) const {
    return lowest_of([&](int m) { return lines_[m].at(point); });
  }
  /// At a place where they stand out so far.
  [[gnu::always_inline]] Lowest lowest_at(const ReachPoint& point,
                                          const std::vector<double>& ahead) const {
    return lowest_of([&](int m) -> Lanes {
      return ahead[m] + (lines_[m].feed + lines_[m].feed_slope * point.part) * point.phi.sine;
    });
  }

  static Lanes first_to_cross(const LowestAt<ReachPoint>&, const LowestAt<ReachPoint>& to) {
    return to.chip.which;
  }

  /// Takes `to` down to a place at which the chip, the smallest at both points, is not, or where
  /// its sign is not that at the lower point.
  /// @return where it did
  [[gnu::always_inline]] auto find_hidden(const Cell& cell, const LowestAt<ReachPoint>& from,
                                          LowestAt<ReachPoint>& to) const {
    auto hides = from.point.part > to.point.part;  // nowhere
    const Lanes sign = from.chip.value >= 0.0 ? Lanes{} + 1.0 : Lanes{} - 1.0;
    for (int m = 0; m <= count(); ++m) {
      const bool is_other = m < count();
      const ReachChip more = is_other ? less(Lanes{} + static_cast<double>(m), from.chip.which)
                                      : times(chip_of(from.chip.which), sign);
      const double least = is_other ? -kEqual : 0.0;
      Seen<ReachPoint> low = see(cell, more, from.point.part);
      for (int k = 1; k <= looks_; ++k) {
        const double node = cell.part + width_ * (static_cast<double>(k) / looks_ - 0.5);
        const Lanes above = node > from.point.part ? Lanes{} + node : from.point.part;
        Seen<ReachPoint> high = see(cell, more, above < to.point.part ? above : to.point.part);
        const auto dips = (high.value >= least) & (low.slope < 0.0) & (high.slope > 0.0);
        Seen<ReachPoint> at = high;
        if (any(dips)) at = select(dips, lowest_between(cell, more, low, high, dips, least), high);
        const auto here = (at.value < least) & (at.point.part > from.point.part) &
                          (at.point.part < to.point.part);
        if (any(here)) {
          to = select(here, LowestAt<ReachPoint>{at.point, lowest_at(at.point)}, to);
          hides |= here;
        }
        low = high;
      }
    }
    return hides;
  }

 private:
  /// Where a chip that falls at one point and rises at another further up is smallest, or is below
  /// `least`, in the lanes that count.
  template <class Mask>
  [[gnu::noinline]] Seen<ReachPoint> lowest_between(const Cell& cell, const ReachChip& chip,
                                                    Seen<ReachPoint> low, Seen<ReachPoint> high,
                                                    Mask counts, double least) const {
    constexpr int kMost = 60;
    constexpr double kNear = 1e-9;  // of the piece: what is left of the value goes with its square
    Seen<ReachPoint> best = high;
    Lanes before = low.point.part;
    Lanes last{};  // 1 where the upper end has moved, -1 where the lower one has
    for (int step = 0; step < kMost && any(counts); ++step) {
      const Lanes range = high.point.part - low.point.part;
      const Lanes part = low.point.part - low.slope * range / (high.slope - low.slope);
      const Seen<ReachPoint> here = see(cell, chip, part);
      best = select(counts, here, best);
      const auto rises = here.slope > 0.0;
      // Illinois: of an end that stays, half the slope.
      high.slope = counts & ~rises & (last < 0.0) ? 0.5 * high.slope : high.slope;
      low.slope = counts & rises & (last > 0.0) ? 0.5 * low.slope : low.slope;
      high = select(counts & rises, here, high);
      low = select(counts & ~rises, here, low);
      last = rises ? Lanes{} + 1.0 : Lanes{} - 1.0;
      const Lanes change = part - before;
      counts &= (here.value >= least) & ((change > kNear) | (change < -kNear));
      before = part;
    }
    return best;
  }

  template <class Value>
  [[gnu::always_inline]] Lowest lowest_of(const Value& value_of) const {
    Lowest best = {Lanes{}, value_of(0)};
    for (int m = 1; m < count(); ++m) {
      const Lanes value = value_of(m);
      best = select(value < best.value, Lowest{Lanes{} + static_cast<double>(m), value}, best);
    }
    return best;
  }

  const LaggingPiece& piece_;
  const std::vector<ReachLine>& lines_;
  int looks_;
  double width_;
};

}  // namespace millstudy::force
