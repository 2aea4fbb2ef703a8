// SPDX-License-Identifier: MIT
// The key table of [stability].
#include "study/key_table.h"

namespace millstudy::study {

using namespace table;

// clang-format off

std::span<const Key> stability_keys() {
  constexpr std::string_view kMethod = "stability.method";
  static const std::vector<Key> keys = {
      {kMethod, kChoice, "", {}, "semi_discretization",
       "method: multipliers of the whole cut, its average over a turn, or a simulation that lets the tool leave the cut",
       MILLSTUDY_SETS(stability.method), {"semi_discretization", "zeroth_order", "time_domain"}},
      {"stability.tolerance", kNumber, "", {1e-10, 0.1}, 1e-3,
       "tolerance: relative, of spectral radius and limits; the discretization is refined until it is met", MILLSTUDY_SETS(stability.tolerance)},
      {"stability.intervals", kInteger, "", {1.0, 1e6}, Optional{},
       "intervals: of a period; instead of a tolerance", MILLSTUDY_SETS(stability.intervals), {}, {kMethod, {"semi_discretization"}}},
      {"stability.order", kInteger, "", {0.0, 2.0}, Optional{},
       "order: of the semi-discretization with so many intervals, 0 where it is not given", MILLSTUDY_SETS(stability.order), {}, {kMethod, {"semi_discretization"}}},
      {"stability.largest_depth_mm", kNumber, "mm", up_to(1000.0), Optional{},
       "largest depth: to which limits are sought where the depth is no axis; else the diameter, or the flute length", MILLSTUDY_SETS(stability.largest_depth)},
      {"stability.revolutions", kInteger, "", {10.0, 1e6}, 400.0,
       "revolutions: simulated at most before a verdict", MILLSTUDY_SETS(stability.revolutions), {}, {kMethod, {"time_domain"}}},
  };
  return keys;
}

// clang-format on

}  // namespace millstudy::study
