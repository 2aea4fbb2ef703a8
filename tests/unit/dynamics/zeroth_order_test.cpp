// SPDX-License-Identifier: MIT
#include "dynamics/zeroth_order.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

#include "core/error.h"
#include "dynamics/depth_limit.h"
#include "dynamics/state_space.h"
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

std::shared_ptr<const MeasuredResponse> sampled(const Machine& machine, int axis, double step) {
  MeasuredResponse response;
  for (double hertz = 1.0; hertz < 6000.0; hertz += step) {
    const double omega = 2.0 * core::kPi * hertz;
    response.omega.push_back(omega);
    response.compliance.push_back(frequency_response(machine, omega)(axis, axis));
  }
  return std::make_shared<const MeasuredResponse>(response);
}

TEST(ZerothOrder, TakesMeasuredResponsesAsTheyAre) {
  const Machine machine = two_in_each();
  const cutter::Cutter cutter{cutter::Shape::flat, 16.0, 4, core::rad_from_deg(30.0)};
  const MeasuredAxes measured = {sampled(machine, 0, 1.0), sampled(machine, 1, 1.0)};
  // Of both in series: y by its modes, x measured.
  Machine y_alone;
  y_alone.y = machine.y;
  double worst = 0.0;
  for (double rpm = 2000.0; rpm < 16000.0; rpm += 500.0) {
    const auto limit = [&](const FrequencyDomain& domain) {
      return zeroth_order_limit(domain, cutter, force::Arc{}, testing::kInsperger,
                                testing::spindle(rpm), 50.0)
          .axial_depth_limit;
    };
    const double modes = limit(frequency_domain(machine));
    worst =
        std::max({worst, std::abs(limit(frequency_domain({}, measured)) / modes - 1.0),
                  std::abs(limit(frequency_domain(y_alone, {measured.x, nullptr})) / modes - 1.0)});
  }
  std::cout << "off by " << worst << "\n";
  EXPECT_LT(worst, 1e-3);
  EXPECT_THROW(frequency_domain({}, {}), core::InputError);
}

TEST(MeasuredResponse, IsContinuousBeyondItsEnds) {
  const auto response = sampled(two_in_each(), 0, 10.0);
  const double last = response->omega.back();
  EXPECT_EQ(response->at(0.0), response->compliance.front());
  EXPECT_NEAR(std::abs(response->at(last * (1.0 - 1e-12)) - response->at(last)), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(response->at(2.0 * last) / response->at(last)), 0.25, 1e-12);
}

}  // namespace
}  // namespace millstudy::dynamics
