// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "path/curve.h"

namespace millstudy::path {

/// Where the chord from a point first reaches its wanted length: within [low, high] of one span,
/// and nowhere before.
struct RootBracket {
  bool found = false;
  std::size_t span = 0;
  double low = 0.0;   ///< t
  double high = 0.0;  ///< t; equal to low where the root is known to rounding
  int pieces = 0;     ///< Bernstein pieces looked at, each about the work of one evaluation
};

/// The first forward root of |R(v) - P| = chord, isolated, equations (P12) to (P14).
///
/// G(v) = |N(v) - w(v) P|^2 - chord^2 w(v)^2 is a polynomial on each span. Written in Bernstein
/// form its coefficients enclose it: all negative, no root on that piece; one change of sign,
/// exactly one root; otherwise the piece is halved, left half first. So no root is passed over,
/// whatever the curve does: cusps, loops, doubled control points, chords longer than the curve.
/// Roots are told apart down to 2^-52 of a span; a chord that touches its length without crossing
/// counts where it touches within rounding.
///
/// @param start  where the tool stands
/// @param from   R at start, about the origin of its span, w = 1
/// @param chord  > 0 [mm]
RootBracket first_chord_root(const Curve& curve, Cursor start, const Homogeneous& from,
                             double chord);

/// How often the Bernstein coefficients of G change sign from start to stop. At most 1 means: the
/// chord reaches its length at most once there, so stop is not beyond a first root and back.
int chord_sign_changes(const Curve& curve, Cursor start, const Homogeneous& from, Cursor stop,
                       double chord);

}  // namespace millstudy::path
