// SPDX-License-Identifier: MIT
// A program outside the tree: one force and one interpolation with the installed engine.
#include <cstdio>
#include <millstudy/force/sampler.h>
#include <millstudy/force/statistics.h>
#include <millstudy/path/interpolate.h>
#include <numbers>

int main() {
  using namespace millstudy;

  // The slot of Haber et al. 2004, Table II: 14 500 rpm, 0.06 mm per tooth.
  const cutter::Cutter mill{cutter::Shape::flat, 12.0, 2, 30.0 * std::numbers::pi / 180.0};
  const force::Coefficients ggg70{2172.0, 850.0, 726.0, 17.3, 7.8, 6.7};
  constexpr int kSteps = 3600;
  const force::ForceSampler sampler(mill, force::slot(0.5), force::EdgeRule{}, kSteps);
  force::ForceSamples samples;
  sampler.sample(ggg70, {0.06}, 0, kSteps, samples);
  force::StatisticsAccumulator statistics;
  statistics.add(samples, kSteps);
  std::printf("mean resultant: %.4f N\n", statistics.result().resultant.mean);

  // A straight line of 10 mm at 3000 mm/min and 2 ms: chords of 0.1 mm.
  path::CurveData line;
  line.degree = 1;
  line.knots = {0.0, 0.0, 1.0, 1.0};
  line.points = {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}};
  path::InterpolationSettings settings;
  settings.feed_rate = 50.0;
  settings.period = 0.002;
  const path::Interpolation walked = path::interpolate(path::Curve(line), settings);
  std::printf("periods along a line: %zu\n", walked.points.size() - 1);
  return 0;
}
