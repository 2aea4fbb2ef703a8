// SPDX-License-Identifier: MIT
#include "process/machine_along.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/watch.h"
#include "process/chord.h"
#include "process/path_engagement.h"

namespace millstudy::process {
namespace {

constexpr double kMostSamples = 1e9;
constexpr std::int64_t kBatch = 4096;  // samples at a time, when one period has more

/// The sampler of one set of arcs, kept until another set is asked for.
class EngagedSampler {
 public:
  EngagedSampler(const force::ForceSampler& sampler, const force::Arc& arc)
      : straight_(sampler), straight_arc_(arc) {}

  const force::ForceSampler& of(const ArcSet& arcs) {
    if (arcs == straight_arc_) return straight_;
    if (!last_ || arcs != last_arcs_) {
      last_ = straight_.with_arcs(arcs.arcs());
      last_arcs_ = arcs;
    }
    return *last_;
  }

 private:
  const force::ForceSampler& straight_;
  ArcSet straight_arc_;
  std::optional<force::ForceSampler> last_;
  ArcSet last_arcs_;
};

/// Of the strip that arcs sweep, over the radius [1].
double width_of(const ArcSet& arcs) {
  double width = 0.0;
  for (const force::Arc& arc : arcs.arcs()) {
    width += std::cos(arc.entry_angle) - std::cos(arc.exit_angle);
  }
  return width;
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
  const PathEngagement engagement(path, machining);
  EngagedSampler samplers(sampler, machining.engagement.arc());
  const double rounding = rounding_of(path);
  double direction = first_direction(path);
  double swept = 0.0;  // (M12): length times width over radius [mm]
  double width = 0.0;
  ArcSet last_arcs;
  for (std::int64_t i = 0; i < periods; ++i) {
    if (i % 16 == 0) core::keep_watch();
    const Chord chord = chord_of(path, i, rounding, direction);
    direction = chord.direction;
    const force::Feed feed{chord.length / teeth_per_period, direction, chord.slope};  // (M1), (M3)
    const ArcSet arcs = engagement.arcs(i, direction);
    const force::ForceSampler& engaged = samplers.of(arcs);
    if (i == 0 || arcs != last_arcs) {
      width = width_of(arcs);
      last_arcs = arcs;
    }
    swept += (chord.slope == 0.0 ? chord.length : chord.length * std::cos(chord.slope)) * width;
    const std::int64_t end = first_sample_of_period(i + 1, samples_per_period);
    for (std::int64_t first = first_sample_of_period(i, samples_per_period); first < end;) {
      const std::int64_t count = std::min(kBatch, end - first);
      engaged.sample(machining.coefficients, feed, first, count, samples);
      figures.add(engaged, machining.coefficients, feed, first, count, samples);
      if (observer) observer(first, count, samples);
      result.samples += count;
      first += count;
    }
  }
  result.figures = figures.result();
  const double section =
      cutter::section_area(sampler.edges().envelope(), machining.engagement.axial_depth);
  result.removal_rate = swept * section / (static_cast<double>(periods) * path.period);
  return result;
}

}  // namespace millstudy::process
