// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "force/chip_phase.h"
#include "force/edge_walk.h"
#include "force/lagging_piece.h"
#include "force/lanes_math.h"
#include "force/part_series.h"
#include "force/tilted_chip.h"

/// Where, up an edge on a tilted axis, the chip of one tooth gives way to that of another, (F28).
namespace millstudy::force {

/// Finds the changes up an edge on a tilted axis.
class TiltedWalk : public EdgeWalk<TiltedWalk> {
 public:
  using Point = force::Point;
  using Chip = TiltedChip;
  static constexpr bool kMayHide = true;

  /// @param chips     of the teeth before, at the angles that are looked at
  /// @param count     how many of them there are
  /// @param carefully  looks also between points at which one chip is the smallest: it may not be
  ///                   so there
  TiltedWalk(const LaggingPiece& piece, const PartSeries& heights, const TiltedChips& chips,
             int count, bool carefully)
      : piece_(piece), heights_(heights), chips_(chips), count_(count), carefully_(carefully) {
    const PartSeries::At low = heights.at(Lanes{}), high = heights.at(Lanes{} + 1.0);
    lowest_ = low.value[0];
    per_height_ = 1.0 / (high.value[0] - lowest_);
    // The immersion angle falls with the height of a right-hand edge.
    const double per_angle = -piece.hand * piece.per_lag;
    const double at_low = low.slope[0] * per_angle, at_high = high.slope[0] * per_angle;
    rise_slope_ = (at_high - at_low) * per_height_;
    rise_ = at_low - rise_slope_ * lowest_;
  }

  int count() const { return count_; }
  bool carefully() const { return carefully_; }

  TiltedChip chip_of(const Lanes& which) const {
    TiltedChip chip = chips_[0];
    for (int m = 1; m < count_; ++m) {
      chip = select(which == static_cast<double>(m), chips_[m], chip);
    }
    return chip;
  }
  TiltedChip less(const Lanes& which, const Lanes& other) const {
    return chip_of(which) - chip_of(other);
  }
  static TiltedChip times(const TiltedChip& chip, const Lanes& factor) { return chip * factor; }
  static Lanes value(const TiltedChip& chip, const Point& point) { return chip.at(point); }

  [[gnu::always_inline]] Seen<Point> see(const Cell& cell, const TiltedChip& chip,
                                         const Lanes& part) const {
    const PartSeries::At height = heights_.at(part);
    const Point point = {part, height.value, cell.phi_at(piece_, part)};
    const ChipLanes here = chip.at_height(point.height);
    return {point, here.at(point.phi),
            height.slope * chip.per_height.at(point.phi) +
                piece_.hand * piece_.lag * (here.p * point.phi.sine - here.q * point.phi.cosine)};
  }

  [[gnu::always_inline]] Lowest lowest_at(const Point& point) const {
    Lowest best = {Lanes{}, chips_[0].at(point)};
    for (int m = 1; m < count_; ++m) {
      const Lanes value = chips_[m].at(point);
      best = select(value < best.value, Lowest{Lanes{} + static_cast<double>(m), value}, best);
    }
    return best;
  }

  /// The one whose chip would cross at the largest cot(phi) if none grew with height.
  [[gnu::always_inline]] Lanes first_to_cross(const LowestAt<Point>& from,
                                              const LowestAt<Point>& to) const {
    const TiltedChip chip = chip_of(from.chip.which);
    const Lanes height = 0.5 * (from.point.height + to.point.height);
    const ChipLanes line = chip.at_height(height);
    const Lanes value = chip.at(to.point);
    const Lanes none = Lanes{} + std::numeric_limits<double>::max();
    Lanes over = none, under = Lanes{} + 1.0, which = to.chip.which;
    for (int m = 0; m < count_; ++m) {
      const ChipLanes other = chips_[m].at_height(height);
      const Lanes q = other.q - line.q, p = piece_.hand * (line.p - other.p);
      const auto sooner = (chips_[m].at(to.point) < value) & (p > 0.0) & (q * under < over * p);
      over = sooner ? q : over;
      under = sooner ? p : under;
      which = sooner ? Lanes{} + static_cast<double>(m) : which;
    }
    return which;
  }

  /// Takes `to` down to a place at which the chip, the smallest at both points, is not, or where
  /// its sign is not that at the lower point. Where no such is left, it is zero once at most.
  /// @return where it did
  [[gnu::always_inline]] auto find_hidden(const Cell& cell, const LowestAt<Point>& from,
                                          LowestAt<Point>& to) const {
    const TiltedChip chip = chip_of(from.chip.which);
    auto hides = from.point.part > to.point.part;  // nowhere
    for (int m = 0; m <= count_; ++m) {
      const bool is_other = m < count_;
      const TiltedChip more = is_other ? chips_[m] - chip : chip;
      const std::array<Lanes, 3> heights =
          heights_of_turning<Lanes>({more.middle.p, more.middle.q},
                                    {more.per_height.p, more.per_height.q}, rise_, rise_slope_);
      for (const Lanes& height : heights) {
        auto here = (height > from.point.height) & (height < to.point.height);
        if (!any(here)) continue;
        const Lanes part = here ? part_at_height(height) : from.point.part;
        const Point point = {part, heights_.at(part).value, cell.phi_at(piece_, part)};
        const Lanes value = more.at(point);
        const auto differs =
            is_other ? value < -kEqual : (value >= 0.0) != (from.chip.value >= 0.0);
        here &= differs & (point.part > from.point.part) & (point.part < to.point.part);
        if (!any(here)) continue;
        to = select(here, LowestAt<Point>{point, lowest_at(point)}, to);
        hides |= here;
      }
    }
    return hides;
  }

 private:
  Lanes part_at_height(const Lanes& height) const {
    Lanes part = (height - lowest_) * per_height_;
    for (int i = 0; i < 3; ++i) {  // of Newton's method
      const PartSeries::At at = heights_.at(part);
      part -= (at.value - height) / at.slope;
    }
    return part;
  }

  const LaggingPiece& piece_;
  const PartSeries& heights_;
  const TiltedChips& chips_;
  int count_;
  bool carefully_;
  double lowest_;      ///< height of the lower end above the middle [mm]
  double per_height_;  ///< one over the height of the piece [1/mm]
  double rise_;        ///< height over immersion angle at the middle [mm/rad]
  double rise_slope_;  ///< and how it grows with height [1/rad]
};

}  // namespace millstudy::force
