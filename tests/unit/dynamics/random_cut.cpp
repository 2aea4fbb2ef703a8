// SPDX-License-Identifier: MIT
#include "unit/dynamics/random_cut.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace millstudy::dynamics::testing {
namespace {

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

AxisMode random_mode(std::mt19937_64& random) {
  return {{uniform(random, 300.0, 2000.0) * 2.0 * core::kPi, uniform(random, 0.01, 0.06)},
          0.0,
          std::pow(10.0, uniform(random, 3.3, 4.7))};
}

}  // namespace

RandomCut random_cut(std::mt19937_64& random) {
  RandomCut cut;
  const auto modes = [&](std::vector<AxisMode>& all, int count) {
    for (int i = 0; i < count; ++i) all.push_back(random_mode(random));
  };
  modes(cut.machine.x, 1 + static_cast<int>(random() % 2));
  modes(cut.machine.y, static_cast<int>(random() % 3));

  cutter::Cutter& cutter = cut.cutter;
  cutter.diameter = uniform(random, 6.0, 25.0);
  cutter.flutes = 1 + static_cast<int>(random() % 6);
  const double hand = random() % 4 == 0 ? -1.0 : 1.0;
  cutter.helix_angle =
      random() % 3 == 0 ? 0.0 : hand * core::rad_from_deg(uniform(random, 5.0, 50.0));
  switch (random() % 8) {
    case 0:
      cutter.shape = cutter::Shape::ball;
      break;
    case 1:
      cutter.shape = cutter::Shape::bull_nose;
      cutter.corner_radius = uniform(random, 0.05, 0.45) * cutter.diameter;
      break;
    case 2:
      cutter.shape = cutter::Shape::taper;
      cutter.taper_angle = core::rad_from_deg(uniform(random, 1.0, 15.0));
      break;
    default:
      cutter.shape = cutter::Shape::flat;
  }
  const double pitch = 2.0 * core::kPi / cutter.flutes;
  if (cutter.flutes > 1 && random() % 3 == 0) {
    double sum = 0.0;
    for (int j = 0; j < cutter.flutes; ++j) {
      cutter.pitch_angles.push_back(pitch * uniform(random, 0.8, 1.2));
      sum += cutter.pitch_angles.back();
    }
    for (double& angle : cutter.pitch_angles) angle *= 2.0 * core::kPi / sum;
  }
  cut.largest_depth = uniform(random, 0.2, 1.5) * cutter.diameter;
  if (cutter.flutes > 1 && cutter.helix_angle != 0.0 && random() % 4 == 0) {
    const double most = std::min(0.15, 0.25 * pitch * 0.5 * cutter.diameter / cut.largest_depth);
    for (int j = 0; j < cutter.flutes; ++j) {
      const double tangent = std::tan(std::abs(cutter.helix_angle)) + uniform(random, 0.0, most);
      cutter.helix_angles.push_back(hand * std::atan(tangent));
    }
  }
  const double radial = uniform(random, 0.05, 1.0) * cutter.diameter;
  switch (random() % 4) {
    case 0:
      break;
    case 1:
      cut.arc = force::up_milling(0.5 * cutter.diameter, radial, 1.0).arc();
      break;
    case 2:
      cut.arc = force::down_milling(0.5 * cutter.diameter, radial, 1.0).arc();
      break;
    default:
      cut.arc.entry_angle = uniform(random, 0.0, 1.5);
      cut.arc.exit_angle = uniform(random, cut.arc.entry_angle + 0.3, core::kPi);
  }
  cut.coefficients = {uniform(random, 400.0, 2500.0),
                      uniform(random, 100.0, 1200.0),
                      uniform(random, 0.0, 800.0),
                      0.0,
                      0.0,
                      0.0};
  const double cycles = std::exp(uniform(random, std::log(0.5), std::log(12.0)));
  cut.spindle_speed = cut.machine.x[0].mode.natural_frequency / cycles / cutter.flutes;
  return cut;
}

std::ostream& operator<<(std::ostream& out, const RandomCut& cut) {
  const cutter::Cutter& c = cut.cutter;
  out << "shape " << static_cast<int>(c.shape) << " D " << c.diameter << " N " << c.flutes
      << " helix " << core::deg_from_rad(c.helix_angle)
      << (c.pitch_angles.empty() ? "" : " unequal pitch")
      << (c.helix_angles.empty() ? "" : " unequal helix") << " arc " << cut.arc.entry_angle << ".."
      << cut.arc.exit_angle << " modes " << cut.machine.x.size() << "+" << cut.machine.y.size()
      << " speed " << cut.spindle_speed << " rad/s, cycles a tooth "
      << cut.machine.x[0].mode.natural_frequency / cut.spindle_speed / c.flutes;
  return out;
}

}  // namespace millstudy::dynamics::testing
