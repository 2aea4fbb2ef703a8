// SPDX-License-Identifier: MIT
#include "dynamics/simulated_edge.h"

#include "core/units.h"

namespace millstudy::dynamics {

SimulatedEdge::SimulatedEdge(const force::CuttingEdges& edges, int discs, int turns,
                             bool all_before) {
  const auto flutes = static_cast<int>(edges.flutes().size());
  const cutter::Runout& runout = edges.cutter().runout;
  for (int j = 0; j < flutes; ++j) {
    const double tangent = edges.flutes()[j].helix_tangent;
    for (int i = 0; i < discs; ++i) {
      const force::EdgeNode node = edges.disc(tangent, discs, i);
      const auto position = [&](int m) {  // of flute j + m, turns included
        const cutter::Flute& flute = edges.flutes()[(j + m) % flutes];
        return flute.position - flute.helix_tangent * node.lag +
               2.0 * core::kPi * ((j + m) / flutes);
      };
      const double own = position(0);
      Disc disc{
          own, node.sin_kappa, node.cos_kappa, node.width, node.length, edges.factors(j, node), {}};
      const int most = all_before ? turns * flutes : 1;
      for (int m = 1; m <= most; ++m) {
        const double other = position(m);
        disc.before.push_back({other - own, cutter::runout_at(runout, own, node.z) -
                                                cutter::runout_at(runout, other, node.z)});
      }
      discs_.push_back(disc);
    }
  }
}

}  // namespace millstudy::dynamics
