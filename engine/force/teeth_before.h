// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <complex>

#include "force/prepared_edges.h"
#include "force/runout_stretch.h"

namespace millstudy::force {

/// The teeth before one tooth, as functions of the spindle angle: what (F23) is made of.
class TeethBefore {
 public:
  TeethBefore(const CuttingEdges& edges, int flute, const Feed& feed)
      : offset_(edges.cutter().runout.offset),
        seen_(edges.flutes()[flute].position - edges.cutter().runout.angle),
        zero_(std::remainder(feed.direction, core::kTurn) + edges.cutter().runout.angle),
        count_(static_cast<int>(edges.flutes().size())) {
    for (int m = 0; m < count_ - 1; ++m) {
      const double ratio = edges.pitch_ratio(flute, 0.0, m + 1);
      const double ahead = ratio * core::kTurn / count_;
      before_[m] = {feed.per_tooth * ratio, 1.0 - std::cos(ahead), std::sin(ahead)};
    }
    before_[count_ - 1] = {feed.per_tooth * count_, 0.0, 0.0};  // itself, a turn ago
  }

  int count() const { return count_; }

  /// The chip under each at spindle angles of which cosine and sine are given.
  [[gnu::always_inline]] void find(const Lanes& c1, const Lanes& s1, ChipLanes* chips) const {
    const Lanes cos_a = offset_ * (c1 * zero_.cosine - s1 * zero_.sine);
    const Lanes sin_a = offset_ * (s1 * zero_.cosine + c1 * zero_.sine);
    for (int m = 0; m < count_; ++m) {
      const Before& b = before_[m];
      chips[m] = {cos_a * b.one_less_cosine - sin_a * b.sine,
                  b.feed + (sin_a * b.one_less_cosine + cos_a * b.sine)};
    }
  }

  /// The line of one over the angle of the tooth's tip.
  LineOfTip of_tip(int m) const { return {ahead(m, offset_, seen_), before_[m].feed}; }

  /// How far the tooth stands out over one, as a complex number that turns with its tip, of axes
  /// that are an offset apart.
  /// @param seen  position of the tip, from where the offset points
  std::complex<double> ahead(int m, double offset, const Angle& seen) const {
    const Before& b = before_[m];
    return offset * std::complex(seen.cosine, -seen.sine) * std::complex(b.one_less_cosine, b.sine);
  }

  /// Chips over sin(kappa) at one point of the edge, each linear in sin(phi): the teeth before have
  /// passed a fixed distance further out or in.
  class AtPoint {
   public:
    /// @param lag  of the point behind the tip
    AtPoint(const TeethBefore& teeth, const Angle& lag) : count_(teeth.count_) {
      const double cosine = teeth.seen_.cosine * lag.cosine + teeth.seen_.sine * lag.sine;
      const double sine = teeth.seen_.sine * lag.cosine - teeth.seen_.cosine * lag.sine;
      for (int m = 0; m < count_; ++m) {
        const Before& b = teeth.before_[m];
        feed_[m] = b.feed;
        ahead_[m] = teeth.offset_ * (b.one_less_cosine * cosine + b.sine * sine);
      }
    }

    double at(int m, double sin_phi) const { return feed_[m] * sin_phi + ahead_[m]; }

    struct Chip {
      int which;
      double value;  ///< [mm]
    };
    Chip smallest_at(double sin_phi) const {
      Chip best = {0, at(0, sin_phi)};
      for (int m = 1; m < count_; ++m) {
        if (at(m, sin_phi) < best.value) best = {m, at(m, sin_phi)};
      }
      return best;
    }

    /// Calls visit(sin_phi) where the smallest changes or its sign does, 0 < sin_phi < 1.
    template <class Visit>
    void for_each_change(const Visit& visit) const {
      int now = smallest_at(0.0).which;
      double from = 0.0;
      while (from < 1.0) {
        int next = now;
        double to = 1.0;
        for (int m = 0; m < count_; ++m) {
          if (!(feed_[m] < feed_[now])) continue;
          const double root = (ahead_[m] - ahead_[now]) / (feed_[now] - feed_[m]);
          if (root < to) next = m, to = root;
        }
        const double zero = -ahead_[now] / feed_[now];
        if (zero > from && zero < to) visit(zero);
        if (next == now) return;
        if (to > 0.0) visit(to);
        now = next;
        from = to;
      }
    }

   private:
    int count_;
    std::array<double, RunoutEdge::kMostFlutes> feed_;   // [mm]
    std::array<double, RunoutEdge::kMostFlutes> ahead_;  // [mm]
  };

 private:
  struct Before {
    double feed;             ///< since it passed [mm]
    double one_less_cosine;  ///< of how far ahead it stands
    double sine;
  };
  double offset_;
  Angle seen_;  ///< position of the tip, from where the offset points
  Angle zero_;
  int count_;
  std::array<Before, RunoutEdge::kMostFlutes> before_;
};

}  // namespace millstudy::force
