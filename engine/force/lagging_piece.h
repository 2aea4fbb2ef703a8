// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "force/edge.h"
#include "force/engagement.h"
#include "force/lanes_math.h"
#include "force/sampling_run.h"
#include "force/tooth_integral.h"

/// A piece of an edge on its way through an arc, which its lower end and its upper one enter and
/// leave one after the other.
namespace millstudy::force {

/// Which end of the stretch in cut is not that of the piece, but where a limit of the arc is.
enum class Cut { none, lower, upper, both };

/// A piece as seen from the tip of its flute.
struct LaggingPiece {
  /// @param helix_tangent  of its flute
  LaggingPiece(const cutter::Envelope& envelope, double helix_tangent, const EdgePiece& piece)
      : hand(force::hand(helix_tangent)),
        lower_shift(helix_tangent * envelope.lag(piece.bottom)),
        upper_shift(helix_tangent * envelope.lag(piece.top)),
        lag(lag_over(helix_tangent, envelope.lag(piece.top) - envelope.lag(piece.bottom))),
        per_lag(1.0 / std::max(lag, 1e-300)) {}

  double hand;        ///< 1 of a right-hand cutter, else -1
  Angle lower_shift;  ///< immersion angle of the tip less that of the lower end
  Angle upper_shift;  ///< and less that of the upper end
  double lag;         ///< of the upper end behind the lower [rad], > 0
  double per_lag;     ///< its reciprocal, finite also without helix

  Closed closed() const { return hand > 0.0 ? Closed::above : Closed::below; }

  /// Which part of the piece, its lower end at an immersion angle, is below the point at another.
  [[gnu::always_inline]] Lanes part_below(const Lanes& phi, const Lanes& lower_angle) const {
    const Lanes past = hand * (lower_angle - phi);
    const Lanes size = past < 0.0 ? -past : past;
    const Lanes part = (size < kAngleSnap ? Lanes{} : past) * per_lag;
    return part > 0.0 ? (part < 1.0 ? part : Lanes{} + 1.0) : Lanes{};
  }
};

/// Angles of the tip at which the ends of a piece pass the limits of an arc.
struct Passage {
  Passage(const LaggingPiece& piece, const Arc& arc) {
    const double lower = piece.lower_shift.value, upper = lower + piece.hand * piece.lag;
    first = arc.entry_angle + std::min(lower, upper);
    entered = arc.entry_angle + std::max(lower, upper);
    leaving = arc.exit_angle + std::min(lower, upper);
    last = arc.exit_angle + std::max(lower, upper);
  }

  /// Calls visit.operator()<Cut>(from, to) for ranges of the tip's angle in turn; one may be empty.
  template <class Visit>
  void for_each_cut(double hand, const Visit& visit) const {
    const double full = std::min(entered, leaving), less = std::max(entered, leaving);
    if (hand > 0.0) {
      visit.template operator()<Cut::upper>(first, full);
      visit.template operator()<Cut::lower>(less, last);
    } else {
      visit.template operator()<Cut::lower>(first, full);
      visit.template operator()<Cut::upper>(less, last);
    }
    if (entered < leaving) {
      visit.template operator()<Cut::none>(entered, leaving);
    } else {
      visit.template operator()<Cut::both>(full, less);
    }
  }

  double first;    ///< some of it is in cut from here on
  double entered;  ///< both ends have passed the entry
  double leaving;  ///< one end has passed the exit
  double last;     ///< both have
};

/// The immersion angle of a point that stands behind the tip of a pass by an angle, at the spindle
/// angles of which cosine and sine are given.
[[gnu::always_inline]] inline SineAndCosine behind(const Pass& pass, const Angle& shift,
                                                   const Lanes& c1, const Lanes& s1) {
  const double c = pass.cosine * shift.cosine + pass.sine * shift.sine;
  const double s = pass.sine * shift.cosine - pass.cosine * shift.sine;
  return {c1 * s + s1 * c, c1 * c - s1 * s};
}

}  // namespace millstudy::force
