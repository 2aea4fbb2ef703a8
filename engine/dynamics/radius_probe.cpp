// SPDX-License-Identifier: MIT
#include "dynamics/radius_probe.h"

#include <algorithm>
#include <cmath>

#include "dynamics/floquet.h"

namespace millstudy::dynamics {

RadiusProbe::Sample RadiusProbe::at_level(double depth, int level) {
  ++evaluations_;
  const DelaySystem system = system_(depth);
  if (search_.intervals > 0) {
    FloquetSettings settings;
    settings.intervals = search_.intervals;
    settings.order = search_.order;
    return {depth, std::log(floquet(system, settings).spectral_radius)};
  }
  RadiusAtLevel found = radius_at_level(system, level, 1e-3 * search_.tolerance, guess_);
  guess_ = std::move(found.vector);
  return {depth, std::log(found.value)};
}

RadiusProbe::Sample RadiusProbe::at(double depth) {
  return at_level(depth, level_);
}

RadiusProbe::Sample RadiusProbe::root(Sample a, Sample b, double& slope) {
  // Regula falsi after Anderson and Bjorck: the end that stays is scaled down, so both close in.
  double fa = a.value, fb = b.value;
  Sample best = std::abs(a.value) < std::abs(b.value) ? a : b;
  slope = (b.value - a.value) / (b.depth - a.depth);
  for (int step = 0; step < 60; ++step) {
    const double width = std::abs(b.depth - a.depth);
    const double close = 0.1 * search_.tolerance * std::max(a.depth, b.depth);
    if (width < close) break;
    const double share = std::clamp(fa / (fa - fb), 0.01, 0.99);
    const Sample c = at(a.depth + share * (b.depth - a.depth));
    const Sample& near = std::abs(c.depth - a.depth) < std::abs(c.depth - b.depth) ? a : b;
    slope = (c.value - near.value) / (c.depth - near.depth);
    best = c;
    if (std::abs(c.value) < 0.3 * close * std::abs(slope)) break;
    if ((c.value < 0.0) == (fb < 0.0)) {
      const double shrink = 1.0 - c.value / fb;
      fa *= shrink > 0.0 ? shrink : 0.5;
    } else {
      a = b;
      fa = fb;
    }
    b = c;
    fb = c.value;
  }
  return best;
}

double RadiusProbe::boundary(Sample a, Sample b) {
  double slope = 0.0;
  Sample found = root(a, b, slope);
  if (search_.intervals > 0) return found.depth - found.value / slope;
  // At the boundary a finer level must give the same, or the search goes on with that.
  while (level_ + 1 < kLevels) {
    const Sample finer = at_level(found.depth, level_ + 1);
    const double correction = finer.value / slope;
    const double moved = std::abs((finer.value - found.value) / slope);
    if (moved < 0.1 * search_.tolerance * found.depth) return found.depth - correction;
    ++level_;
    // Both ends again, further out until they differ.
    double reach = std::max(2.0 * std::abs(correction), search_.tolerance * found.depth);
    Sample low = finer, high = finer;
    for (int i = 0; i < 40 && (low.value < 0.0) == (high.value < 0.0); ++i, reach *= 2.0) {
      low = at(std::max(found.depth - reach, 1e-3 * found.depth));
      high = at(found.depth + reach);
    }
    if ((low.value < 0.0) == (high.value < 0.0)) return found.depth;
    found = root(low, high, slope);
  }
  return found.depth - found.value / slope;
}

}  // namespace millstudy::dynamics
