// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <random>
#include <string>

#include "unit/force/cases.h"
#include "unit/force/reference_integral.h"

/// Seeded random end mills of all shapes, and cuts with them.
namespace millstudy::force::testing {

enum class Kind {
  flat,
  ball,
  tapered_ball,
  bull_nose,
  taper,            ///< both signs, both leads
  general,          ///< tangent corner
  general_centred,  ///< centre of the corner given
  profile,
};

std::string name(Kind kind);

/// One to six flutes, equal or listed pitch, one helix or one each of the same hand; runout from
/// 0.01 to 3 times the feed; one or two arcs; depths from microns to several turns; feed slopes
/// within 15 deg; coefficients constant, by height, by chip, orthogonal. Never one that the engine
/// refuses.
reference::Cut random_cut(std::mt19937_64& random, Kind kind);

/// What makes a cut special: "runout", "slope", ... joined by '+'.
std::string features(const reference::Cut& cut);

/// As initialisers, every digit.
std::ostream& operator<<(std::ostream& out, const reference::Cut& cut);

}  // namespace millstudy::force::testing

namespace millstudy::force::reference {
using testing::operator<<;
}
