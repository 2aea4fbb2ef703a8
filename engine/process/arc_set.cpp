// SPDX-License-Identifier: MIT
#include "process/arc_set.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace millstudy::process {

ArcSet within_cap(const ArcSet& set, double direction, double least) {
  if (least <= -1.0) return set;
  ArcSet kept;
  if (!(least <= 1.0)) return kept;
  // |phi - middle| <= half, in every turn that reaches 0 .. pi: middle is within +- pi, half < pi.
  const double half = std::acos(least);
  const double middle = std::remainder(direction + 0.5 * core::kPi, core::kTurn);
  for (const force::Arc& arc : set.arcs()) {
    for (const double turn : {0.0, core::kTurn}) {
      kept.add({std::max(arc.entry_angle, middle - half + turn),
                std::min(arc.exit_angle, middle + half + turn)});
    }
  }
  return kept;
}

}  // namespace millstudy::process
