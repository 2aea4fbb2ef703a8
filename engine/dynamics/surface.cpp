// SPDX-License-Identifier: MIT
#include "dynamics/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "cutter/flutes.h"

namespace millstudy::dynamics {
namespace {

constexpr int kSamplingLengths = 5;

}  // namespace

MachinedWall::MachinedWall(const force::CuttingEdges& edges, const PeriodicMotion& motion,
                           double spindle_speed, double feed_per_tooth, Wall wall)
    : edges_(edges),
      motion_(motion),
      speed_(spindle_speed),
      feed_per_turn_(feed_per_tooth * edges.cutter().flutes),
      side_(wall == Wall::up ? 1.0 : -1.0) {}

std::vector<MachinedWall::Pass> MachinedWall::passes(double z) const {
  std::vector<Pass> all;
  const double lag = edges_.envelope().lag(z);
  const double radius = edges_.envelope().segment_at(z).radius_at(z);
  const double at_wall = side_ > 0.0 ? 0.0 : core::kPi;
  for (const cutter::Flute& flute : edges_.flutes()) {
    const double position = flute.position - flute.helix_tangent * lag;
    const double angle = at_wall - position;
    all.push_back({(angle - core::kTurn * std::floor(angle / core::kTurn)) / speed_,
                   radius + cutter::runout_at(edges_.cutter().runout, position, z)});
  }
  return all;
}

double MachinedWall::offset(const Pass& pass, double z, double time) const {
  const double radius = edges_.envelope().segment_at(z).radius_at(z);
  const double turned = speed_ * (time - pass.time), half = std::sin(0.5 * turned);
  return side_ * motion_.at(time)[1] + (pass.radius - radius) - 2.0 * pass.radius * half * half;
}

double MachinedWall::location_error(double z) const {
  double deepest = -1e300;
  for (const Pass& pass : passes(z)) deepest = std::max(deepest, offset(pass, z, pass.time));
  return deepest;
}

/// Where the tooth of a pass is as it passes a place along the feed: (D33) solved for the time.
double MachinedWall::time_at(const Pass& pass, double x) const {
  const double feed_rate = feed_per_turn_ * speed_ / core::kTurn;
  double time =
      pass.time + (x - feed_rate * pass.time) / (feed_rate + side_ * pass.radius * speed_);
  for (int step = 0; step < 30; ++step) {
    // With the speed of the tooth alone, each step leaves a small share of the error.
    const double turned = speed_ * (time - pass.time);
    const double error =
        x - feed_rate * time - motion_.at(time)[0] - side_ * pass.radius * std::sin(turned);
    time += error / (feed_rate + side_ * pass.radius * speed_ * std::cos(turned));
    if (std::abs(error) < 1e-12 * pass.radius) break;
  }
  return time;
}

std::vector<double> MachinedWall::profile(double z, int samples) const {
  // Each tooth's arc over the feed of a turn to either side of where it passes the wall, as a
  // table.
  constexpr int kHalf = 24, kMargin = 2;
  const double feed_rate = feed_per_turn_ * speed_ / core::kTurn;
  const double spacing = 1.1 * feed_per_turn_ / kHalf;
  std::vector<double> offsets(samples, -1e300);
  for (const Pass& pass : passes(z)) {
    const double middle = feed_rate * pass.time + motion_.at(pass.time)[0];
    std::array<double, 2 * (kHalf + kMargin) + 1> arc;
    for (int k = -kHalf - kMargin; k <= kHalf + kMargin; ++k) {
      arc[k + kHalf + kMargin] = offset(pass, z, time_at(pass, middle + k * spacing));
    }
    for (int i = 0; i < samples; ++i) {
      const double x = feed_per_turn_ * i / samples;
      for (int back = -3; back <= 3; ++back) {
        const double at = (x - middle - back * feed_per_turn_) / spacing;
        if (std::abs(at) > kHalf) continue;
        const double whole = std::floor(at), t = at - whole;
        const double* p = arc.data() + static_cast<int>(whole) + kHalf + kMargin;
        const double here = -t * (t - 1.0) * (t - 2.0) / 6.0 * p[-1] +
                            (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0 * p[0] -
                            (t + 1.0) * t * (t - 2.0) / 2.0 * p[1] +
                            (t + 1.0) * t * (t - 1.0) / 6.0 * p[2];
        offsets[i] = std::max(offsets[i], here);
      }
    }
  }
  return offsets;
}

Roughness roughness(const std::vector<double>& profile, double period, double sampling_length) {
  const auto count = static_cast<std::int64_t>(profile.size());
  const double spacing = period / static_cast<double>(count);
  const auto points = std::max<std::int64_t>(2, std::llround(sampling_length / spacing));
  Roughness mean;
  for (int length = 0; length < kSamplingLengths; ++length) {
    // What repeats whole periods need not be looked at more than once or twice.
    const std::int64_t first = length * points;
    const auto at = [&](std::int64_t i) { return profile[(first + i) % count]; };
    const auto n = static_cast<double>(points);
    double line = 0.0;
    for (std::int64_t i = 0; i < points; ++i) line += at(i) / n;
    double sum = 0.0, square = 0.0, low = 1e300, high = -1e300;
    for (std::int64_t i = 0; i < points; ++i) {
      const double height = at(i) - line;
      sum += std::abs(height);
      square += height * height;
      low = std::min(low, height);
      high = std::max(high, height);
    }
    mean.ra += sum / n / kSamplingLengths;
    mean.rq += std::sqrt(square / n) / kSamplingLengths;
    mean.rz += (high - low) / kSamplingLengths;
  }
  return mean;
}

double cusp_height(const cutter::Envelope& envelope, double stepover) {
  const double radius = 0.5 * stepover;
  // The radius does not fall with height: the lowest height at which it is reached, by halving.
  double low = 0.0, high = 1e-3;
  if (envelope.segment_at(0.0).radius_at(0.0) >= radius) return 0.0;
  while (high < envelope.length() && envelope.segment_at(high).radius_at(high) < radius &&
         high < 1e4)
    high *= 2.0;
  high = std::min(high, envelope.length());
  if (envelope.segment_at(high).radius_at(high) < radius) {
    throw core::CaseError("finish.stepover_mm must be <= the diameter of the cutter");
  }
  for (int step = 0; step < 200 && high - low > 1e-13 * high; ++step) {
    const double middle = 0.5 * (low + high);
    (envelope.segment_at(middle).radius_at(middle) < radius ? low : high) = middle;
  }
  return high;
}

}  // namespace millstudy::dynamics
