// SPDX-License-Identifier: MIT
#include "dynamics/depth_limit.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "dynamics/floquet.h"
#include "dynamics/radius_probe.h"

namespace millstudy::dynamics {
namespace {

using Sample = RadiusProbe::Sample;

void check(const DepthSearch& search) {
  if (!(search.largest_depth > 0.0 && std::isfinite(search.largest_depth))) {
    throw core::InputError(
        fmt::format("largest depth = {} mm must be > 0 and finite", search.largest_depth));
  }
  if (!(search.tolerance >= 1e-8 && search.tolerance <= 0.1)) {
    throw core::InputError(
        fmt::format("tolerance = {} must be between 1e-8 and 0.1", search.tolerance));
  }
  if (search.samples < 4) {
    throw core::InputError(fmt::format("samples = {} must be >= 4", search.samples));
  }
}

/// The place of the extremum of the parabola through three samples that crosses zero, or < 0.
double vertex_across(const Sample& a, const Sample& b, const Sample& c) {
  const double left = (b.value - a.value) / (b.depth - a.depth);
  const double right = (c.value - b.value) / (c.depth - b.depth);
  const double bend = (right - left) / (c.depth - a.depth);
  const double sign = b.value < 0.0 ? 1.0 : -1.0;
  if (!(sign * left > 0.0 && sign * right < 0.0) || bend == 0.0) return -1.0;
  const double slope = left + bend * (b.depth - a.depth);  // at b
  const double along = -0.5 * slope / bend;
  const double top = b.value + 0.5 * slope * along;
  // Half as far again as the parabola says: the radius has corners where multipliers change places.
  return sign * (top + 0.5 * (top - 0.5 * (a.value + c.value))) > 0.0 ? b.depth + along : -1.0;
}

/// Samples between which nothing more hides, as far as parabolas tell.
void refine(std::vector<Sample>& samples, RadiusProbe& probe) {
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<Sample> more;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
      const Sample &a = samples[i - 1], &b = samples[i], &c = samples[i + 1];
      if ((a.value < 0.0) != (b.value < 0.0) || (b.value < 0.0) != (c.value < 0.0)) continue;
      const double depth = vertex_across(a, b, c);
      const double least = 0.02 * (c.depth - a.depth);
      if (depth > 0.0 && std::abs(depth - b.depth) > least) more.push_back(probe.at(depth));
    }
    if (more.empty()) return;
    samples.insert(samples.end(), more.begin(), more.end());
    std::sort(samples.begin(), samples.end(),
              [](const Sample& a, const Sample& b) { return a.depth < b.depth; });
  }
}

}  // namespace

DepthLimits depth_limits(const SystemAtDepth& system, const DepthSearch& search, int first_level) {
  check(search);
  RadiusProbe probe(system, search, std::clamp(first_level, 0, kLevels - 1));
  std::vector<Sample> samples;
  for (int i = 1; i <= search.samples; ++i) {
    const double share = static_cast<double>(i) / search.samples;
    samples.push_back(probe.at(search.largest_depth * std::pow(share, 1.5)));
  }
  refine(samples, probe);
  DepthLimits limits;
  // Without depth there is no cut and a machine with damping is stable.
  double from = 0.0;
  bool stable = true;
  if (samples.front().value >= 0.0) {
    Sample low = samples.front();
    for (int i = 0; i < 30 && low.value >= 0.0; ++i) low = probe.at(0.3 * low.depth);
    if (low.value < 0.0) limits.stable.push_back({0.0, probe.boundary(low, samples.front())});
    stable = false;
  }
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const bool now = samples[i].value < 0.0;
    if (now == stable) continue;
    const double depth = probe.boundary(samples[i - 1], samples[i]);
    if (now)
      from = depth;
    else
      limits.stable.push_back({from, depth});
    stable = now;
  }
  if (stable) limits.stable.push_back({from, search.largest_depth});
  limits.axial_depth_limit =
      limits.stable.empty() || limits.stable.front().from > 0.0 ? 0.0 : limits.stable.front().to;
  limits.evaluations = probe.evaluations();
  limits.level = probe.level();
  return limits;
}

}  // namespace millstudy::dynamics
