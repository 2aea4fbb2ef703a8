// SPDX-License-Identifier: MIT
#include "process/machine_along.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"

namespace millstudy::process {
namespace {

constexpr double kMostSamples = 1e9;
constexpr std::int64_t kBatch = 4096;  // samples at a time, when one period has more

void check_planar(const path::Interpolation& path) {
  for (const path::Vec3& point : path.points) {
    if (point.z != path.points.front().z) {
      throw core::CaseError(
          "the path climbs out of the xy plane: forces along it are not supported");
    }
  }
}

}  // namespace

std::int64_t first_sample_of_period(std::int64_t i, double samples_per_period) {
  // n S T is often a whole number that rounding has moved; the sample is then the boundary's own.
  constexpr double kRounding = 1e-9;
  return static_cast<std::int64_t>(
      std::ceil(static_cast<double>(i) * samples_per_period - kRounding));
}

PathForces machine_along(const path::Interpolation& path, const force::ForceSampler& sampler,
                         const Machining& machining, const SampleObserver& observer) {
  assert(sampler.angular_steps() == machining.angular_steps);
  check_planar(path);
  const auto periods = static_cast<std::int64_t>(path.points.size()) - 1;
  const double samples_per_period =
      path.period * machining.spindle_speed * machining.angular_steps;  // (M2)
  if (static_cast<double>(periods) * samples_per_period > kMostSamples) {
    throw core::CaseError("the path needs more than 1e9 force samples: use fewer angular_steps");
  }
  const double teeth_per_period = path.period * machining.spindle_speed * machining.cutter.flutes;

  PathForces result;
  force::FigureAccumulator figures(machining.figures, sampler);
  force::ForceSamples samples;
  for (std::int64_t i = 0; i < periods; ++i) {
    const path::Vec3& from = path.points[i];
    const path::Vec3& to = path.points[i + 1];
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const double feed_per_tooth = std::hypot(dx, dy) / teeth_per_period;  // (M1)
    const double feed_direction = std::atan2(dy, dx);                     // (M3)
    const force::Feed feed = {feed_per_tooth, feed_direction};
    const std::int64_t end = first_sample_of_period(i + 1, samples_per_period);
    for (std::int64_t first = first_sample_of_period(i, samples_per_period); first < end;) {
      const std::int64_t count = std::min(kBatch, end - first);
      sampler.sample(machining.coefficients, feed, first, count, samples);
      figures.add(sampler, machining.coefficients, feed, first, count, samples);
      if (observer) observer(first, count, samples);
      result.samples += count;
      first += count;
    }
  }
  result.figures = figures.result();
  return result;
}

}  // namespace millstudy::process
