// SPDX-License-Identifier: MIT
// The key table of [finish].
#include "study/key_table.h"

namespace millstudy::study {

using namespace table;

// clang-format off

std::span<const Key> finish_keys() {
  constexpr std::string_view kMethod = "finish.method";
  static const std::vector<Key> keys = {
      {kMethod, kChoice, "", {}, "periodic",
       "method: the periodic vibration of the linear cut, or a simulation that lets teeth miss their cut, for runout and a size effect",
       MILLSTUDY_SETS(finish.method), {"periodic", "time_domain"}},
      {"finish.tolerance", kNumber, "", {1e-8, 0.1}, 1e-4,
       "tolerance: relative, of the vibration; the discretization is refined until it is met", MILLSTUDY_SETS(finish.tolerance), {}, {kMethod, {"periodic"}}},
      {"finish.revolutions", kInteger, "", {10.0, 1e6}, 400.0,
       "revolutions: simulated at most", MILLSTUDY_SETS(finish.revolutions), {}, {kMethod, {"time_domain"}}},
      {"finish.wall", kChoice, "", {}, "automatic",
       "wall: the up-milled (entry at 0) or the down-milled one (exit at 180 deg); automatic is the one there is, in a slot the up-milled",
       MILLSTUDY_SETS(finish.wall), {"automatic", "up", "down"}},
      {"finish.height_mm", kNumber, "mm", {0.0, 1000.0}, Optional{},
       "height: above the tip, at which the wall is measured; else half the axial depth", MILLSTUDY_SETS(finish.height)},
      {"finish.sampling_length_mm", kNumber, "mm", up_to(100.0), 0.8,
       "sampling length: of ISO 4287; roughness is that of five of them, along the feed", MILLSTUDY_SETS(finish.sampling_length)},
      {"finish.stepover_mm", kNumber, "mm", up_to(1000.0), Optional{},
       "stepover: between passes beside one another, adds the height of the cusps between them", MILLSTUDY_SETS(finish.stepover)},
  };
  return keys;
}

// clang-format on

}  // namespace millstudy::study
