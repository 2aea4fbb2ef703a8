// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

#include "force/engagement.h"

namespace millstudy::process {

/// Arcs shorter than this are no cut [rad].
inline constexpr double kShortestArc = 1e-12;

/// The immersion angles in cut: arcs in ascending order, none of which overlap.
class ArcSet {
 public:
  ArcSet() = default;
  explicit ArcSet(const force::Arc& arc) { add(arc); }

  /// At the end; nothing if it is shorter than kShortestArc.
  void add(const force::Arc& arc) {
    if (!(arc.exit_angle - arc.entry_angle >= kShortestArc)) return;
    assert(count_ < arcs_.size());
    arcs_[count_++] = arc;
  }

  /// Each face of a stock cuts one arc out of the circle, and so adds at most one arc to a set.
  static constexpr std::size_t kMost = 3;

  std::span<const force::Arc> arcs() const { return {arcs_.data(), count_}; }
  bool empty() const { return count_ == 0; }

  /// The same bits.
  friend bool operator==(const ArcSet& a, const ArcSet& b) {
    if (a.count_ != b.count_) return false;
    for (std::size_t i = 0; i < a.count_; ++i) {
      if (a.arcs_[i].entry_angle != b.arcs_[i].entry_angle ||
          a.arcs_[i].exit_angle != b.arcs_[i].exit_angle) {
        return false;
      }
    }
    return true;
  }

 private:
  std::array<force::Arc, kMost> arcs_{};
  std::size_t count_ = 0;
};

/// What of a set lies where sin(phi - direction) >= least, a cap of the circle.
///
/// @param direction  [rad], any
/// @param least      from -1 on down everything is kept, with the same bits; above 1 nothing
ArcSet within_cap(const ArcSet& set, double direction, double least);

}  // namespace millstudy::process
