// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "force/runout_stretch.h"

/// Where, up an edge, the chip of one tooth gives way to that of another, (F23), a vector of
/// spindle angles at a time.
namespace millstudy::force {

/// Where a chip is zero, as a fraction of positive denominator: compared without division.
struct Root {
  Lanes over;
  Lanes under;

  auto operator<(const Root& other) const { return over * other.under < other.over * under; }
};

template <class Mask>
[[gnu::always_inline]] inline Root select(const Mask& mask, const Root& a, const Root& b) {
  return {mask ? a.over : b.over, mask ? a.under : b.under};
}

/// Where, at the angles of a few vectors, the edge crosses from one line to another. What is noted
/// is there; the rest of the memory is not touched.
struct Crossings {
  static constexpr int kMost = 64;
  /// Vectors that there is room for: of each note_changes() notes the beginning of the chip and, in
  /// up to a step for every tooth and one more, what it gives way to.
  static constexpr int vectors(int teeth) { return kMost / (teeth + 2); }

  /// @param n     the first angle of the vector
  /// @param chip  difference of that below the crossing and that above
  /// @param edge_forces  1 where they end there, -1 where they begin, else 0
  template <class Mask>
  void push(const Mask& where, int n, const ChipLanes& chip, double edge_forces) {
    first[count] = n;
    p[count] = where ? chip.p : Lanes{};
    q[count] = where ? chip.q : Lanes{};
    edge[count] = where ? Lanes{} + edge_forces : Lanes{};
    ++count;
  }
  Line line(int i) const { return {{p[i], q[i]}, edge[i]}; }

  int count = 0;
  std::array<int, kMost> first;
  std::array<Lanes, kMost> p;
  std::array<Lanes, kMost> q;
  std::array<Lanes, kMost> edge;
};

/// Those whose edge forces stay, and those whose do not.
struct Changes {
  Crossings of_teeth;  ///< from the chip of one to that of another
  Crossings of_chip;   ///< where it begins or ends
};

/// What of an edge is in cut, at a vector of angles.
struct EdgeInCut {
  int n;        ///< index of the first angle
  double hand;  ///< 1 of a right-hand cutter, else -1
  std::span<const ChipLanes> chips;
  SineAndCosine bottom;  ///< of the immersion angle
  SineAndCosine top;
};

/// Walks up the edge, where it crosses, from line to line and notes each change. `line` is that at
/// the bottom, and then that at the top, which should be `last`.
template <class Mask>
[[gnu::always_inline]] inline void note_changes(const EdgeInCut& in_cut, const Mask& crosses,
                                                Line& line, const Line& last, Changes& changes) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  // Over sin(phi) chips are linear in the cotangent, which goes up with the edge of a right-hand
  // cutter. At 0 and pi the sine may come out below zero by rounding: that would turn the sign.
  const double hand = in_cut.hand;
  const Lanes one = Lanes{} + 1.0;
  const auto root_at = [&](const SineAndCosine& phi) -> Root {
    return {hand * phi.cosine, larger(phi.sine, Lanes{} + 1e-300)};
  };
  const Root at_top = root_at(in_cut.top);
  // The chip begins where the last of the rising ones becomes positive, unless one of the others
  // is negative by then, or was at the bottom.
  const auto starts_without = crosses & (line.edge == 0.0);
  if (any(starts_without)) {
    Root begin = {Lanes{} - kHuge, one}, end = at_top;
    ChipLanes first{};
    for (const ChipLanes& chip : in_cut.chips) {
      const Lanes p = hand * chip.p, q = chip.q;
      const Root rises = {-q, p}, falls = {q, -p};
      const auto later = (p > 0.0) & (begin < rises);
      begin = select(later, rises, begin);
      first = select(later, chip, first);
      end = select((p < 0.0) & (falls < end), falls, end);
      end = select((p == 0.0) & (q < 0.0), Root{Lanes{} - kHuge, one}, end);
    }
    const auto where =
        starts_without & (begin.over > -kHuge) & (begin < end) & (root_at(in_cut.bottom) < end);
    if (any(where)) {
      changes.of_chip.push(where, in_cut.n, {-first.p, -first.q}, -1.0);
      line = {select(where, first, line), where ? one : line.edge};
    }
  }
  // Slopes fall from chip to chip, so that no more than all can follow; see Crossings::vectors().
  for (std::size_t step = 0; step <= in_cut.chips.size(); ++step) {
    const auto walks = crosses & ((line.p != last.p) | (line.q != last.q));
    if (!any(walks)) return;
    const Lanes p = hand * line.p;
    const auto falls = p < 0.0;
    Root end = {falls ? line.q : Lanes{} + kHuge, falls ? -p : one};
    ChipLanes next{};
    auto is_chip = next.p != 0.0;
    for (const ChipLanes& chip : in_cut.chips) {
      const Root crossing = {chip.q - line.q, p - hand * chip.p};
      const auto sooner = (crossing.under > 0.0) & (crossing < end);
      end = select(sooner, crossing, end);
      next = select(sooner, chip, next);
      is_chip |= sooner;
    }
    const auto where = walks & (line.edge > 0.0) & (end < at_top);
    const auto ends = where & ~is_chip, goes_on = where & is_chip;
    if (any(goes_on)) {
      changes.of_teeth.push(goes_on, in_cut.n, {line.p - next.p, line.q - next.q}, 0.0);
    }
    if (any(ends)) {
      changes.of_chip.push(ends, in_cut.n, line, 1.0);
    } else if (!any(goes_on)) {
      return;
    }
    line = {select(where, next, line), ends ? Lanes{} : line.edge};
  }
}

}  // namespace millstudy::force
