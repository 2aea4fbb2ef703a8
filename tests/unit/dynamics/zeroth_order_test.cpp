// SPDX-License-Identifier: MIT
#include "dynamics/zeroth_order.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

#include "dynamics/depth_limit.h"
#include "unit/dynamics/insperger.h"

namespace millstudy::dynamics {
namespace {

Machine two_in_each() {
  const double turn = 2.0 * core::kPi;
  Machine machine;
  machine.x = {{{452.8 * turn, 0.12}, 0.0, 1.0e4}, {{1448.5 * turn, 0.0170}, 0.0, 8.0e4}};
  machine.y = {{{516.3 * turn, 0.024}, 0.0, 9.7e3}, {{1407.0 * turn, 0.032}, 0.0, 4.0e4}};
  return machine;
}

// There the directional matrix is constant and the solution is exact.
TEST(ZerothOrder, IsExactInASlotWithAnEvenNumberOfTeethFrom4Up) {
  const Machine machine = two_in_each();
  for (const int flutes : {4, 6, 8}) {
    for (const double helix_deg : {0.0, 30.0}) {
      const cutter::Cutter cutter{cutter::Shape::flat, 16.0, flutes, core::rad_from_deg(helix_deg)};
      for (const double rpm : {2000.0, 5500.0, 12000.0}) {
        const double speed = testing::spindle(rpm);
        const ZerothOrderLimit zeroth = zeroth_order_limit(
            frequency_domain(machine), cutter, force::Arc{}, testing::kInsperger, speed, 50.0);
        DepthSearch search;
        search.largest_depth = 2.0 * zeroth.axial_depth_limit;
        search.tolerance = 1e-7;
        const double exact =
            depth_limits(
                [&](double depth) {
                  return delay_system(machine, {cutter, force::slot(depth), testing::kInsperger},
                                      speed);
                },
                search)
                .axial_depth_limit;
        std::cout << flutes << " flutes, helix " << helix_deg << " deg, " << rpm
                  << " rpm: " << zeroth.axial_depth_limit << " mm, "
                  << zeroth.chatter_frequency / (2.0 * core::kPi) << " Hz, off by "
                  << zeroth.axial_depth_limit / exact - 1.0 << "\n";
        EXPECT_NEAR(zeroth.axial_depth_limit, exact, 1e-5 * exact);
      }
    }
  }
}

}  // namespace
}  // namespace millstudy::dynamics
