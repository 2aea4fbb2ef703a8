// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/units.h"
#include "force/nonlinear_force.h"
#include "identify/fit.h"

/// Measured forces that are known to the last digit, by a kernel that fits do not use.
namespace millstudy::identify::testing {

/// How a record is made.
struct Truth {
  cutter::Cutter cutter;  ///< with its runout
  force::Engagement engagement;
  force::Coefficients coefficients;
  force::Variation variation = {};
  double feed_rate = 10.0;      ///< [mm/s]
  double spindle_speed = 80.0;  ///< [rad/s]
  double phase = 0.0;           ///< of the tip of flute 0 at the first sample [rad]
  std::array<double, 3> offset{};
  double sampling_rate = 5000.0;
  std::size_t samples = 1500;
};

inline Record make_record(const Truth& truth, const std::string& name) {
  const auto edges = std::make_shared<const force::CuttingEdges>(
      truth.cutter, truth.engagement.axial_depth, truth.variation);
  const force::NonlinearForce kernel(edges, {});
  const double feed =
      truth.feed_rate * 2.0 * core::kPi / (truth.spindle_speed * truth.cutter.flutes);
  const force::Arc arc = truth.engagement.arc();
  Record record{name,
                {name, truth.sampling_rate, 0.0, {}},
                truth.engagement,
                truth.feed_rate,
                truth.spindle_speed};
  for (std::size_t i = 0; i < truth.samples; ++i) {
    const double angle =
        truth.phase + truth.spindle_speed * static_cast<double>(i) / truth.sampling_rate;
    std::array<double, 3> sum = truth.offset;
    for (std::size_t j = 0; j < edges->flutes().size(); ++j) {
      const auto force =
          kernel.of_flute(static_cast<int>(j), angle + edges->flutes()[j].position, {&arc, 1},
                          truth.coefficients, {feed}, force::Rows::forces);
      for (int axis = 0; axis < 3; ++axis) sum[axis] += force[axis];
    }
    for (int axis = 0; axis < 3; ++axis) record.trace.force[axis].push_back(sum[axis]);
  }
  return record;
}

/// Adds noise that is correlated from sample to sample.
///
/// @param deviation    [N]
/// @param correlation  of neighbours
inline void add_noise(Record& record, double deviation, double correlation,
                      std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  for (std::vector<double>& force : record.trace.force) {
    double noise = normal(random);
    for (double& f : force) {
      f += deviation * noise;
      noise = correlation * noise + std::sqrt(1.0 - correlation * correlation) * normal(random);
    }
  }
}

/// A two-flute slot of GGG-70 with runout.
inline Truth slot_truth() {
  Truth truth;
  truth.cutter = {cutter::Shape::bull_nose, 16.0, 2, core::rad_from_deg(25.0)};
  truth.cutter.corner_radius = 3.0;
  truth.cutter.runout = {0.012, 0.7};
  truth.engagement = force::slot(2.0);
  truth.coefficients = {2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};
  truth.phase = 1.234;
  return truth;
}

inline std::array<double, 6> values(const force::Coefficients& k) {
  return {k.Ktc, k.Krc, k.Kac, k.Kte, k.Kre, k.Kae};
}

}  // namespace millstudy::identify::testing
