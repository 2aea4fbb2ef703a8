// SPDX-License-Identifier: MIT
#include "force/sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/units.h"
#include "cutter/envelope.h"
#include "force/lanes.h"
#include "force/prepared_edges.h"
#include "force/sampling_run.h"

namespace millstudy::force {
namespace {

constexpr int kMostAngularSteps = 10'000'000;

int checked_steps(int angular_steps) {
  if (angular_steps < 1 || angular_steps > kMostAngularSteps) {
    throw core::InputError("angular_steps = " + std::to_string(angular_steps) +
                           " must be between 1 and " + std::to_string(kMostAngularSteps));
  }
  return angular_steps;
}

/// Repeats the first `period` values over the rest.
void repeat(double* values, std::int64_t period, std::int64_t count) {
  for (std::int64_t done = period; done < count; done += period) {
    std::copy_n(values, std::min(period, count - done), values + done);
  }
}

}  // namespace

void ForceSamples::resize(std::size_t count) {
  for (std::vector<double>* row : {&x, &y, &z, &torque}) row->resize(count);
}

struct ForceSampler::Geometry {
  Geometry(const cutter::Cutter& cutter, const Engagement& engagement, const EdgeRule& edge_rule,
           int angular_steps)
      : tables(angular_steps, cutter.flutes) {
    const double depth = engagement.axial_depth;
    const double top = std::min(depth, cutter::curved_height(cutter));
    if (edge_rule.rule == Rule::discs) {
      discs.emplace(cutter, engagement, edge_rule.discs);
      return;
    }
    if (top > 0.0) curved.emplace(cutter, engagement, top);
    if (top < depth) cylinder.emplace(cutter, engagement, top, depth);
  }

  void add_to(SamplingRun& run) const {
    if (curved) curved->add_to(run);
    if (cylinder) cylinder->add_to(run);
    if (discs) discs->add_to(run);
  }

  AngleTables tables;
  std::optional<CurvedEdge> curved;
  std::optional<CylinderEdge> cylinder;
  std::optional<DiscEdge> discs;
};

ForceSampler::ForceSampler(const cutter::Cutter& cutter, const Engagement& engagement,
                           const EdgeRule& edge_rule, int angular_steps)
    : angular_steps_(checked_steps(angular_steps)) {
  cutter::check(cutter);
  check(cutter, engagement);
  check(edge_rule);
  geometry_ = std::make_shared<const Geometry>(cutter, engagement, edge_rule, angular_steps);
}

void ForceSampler::sample(const Coefficients& coefficients, double feed_per_tooth,
                          double feed_direction, std::int64_t first, std::int64_t count,
                          ForceSamples& out) const {
  const std::int64_t period = geometry_->tables.period;
  // Whole vectors are written, so there must be room for one that begins at the last sample.
  const std::size_t room = count + kLanes;
  if (out.x.size() < room) out.resize(room);
  const std::array<double*, kRows> rows = {out.x.data(), out.y.data(), out.z.data(),
                                           out.torque.data()};
  const double direction = std::remainder(feed_direction, 2.0 * core::kPi);
  const Combination with = {loads(coefficients, feed_per_tooth), std::cos(direction),
                            std::sin(direction)};
  const std::int64_t begin = ((first % period) + period) % period;
  const std::int64_t fresh = std::min(count, period);
  // The samples of one period are begin .. period - 1 and then 0 .. begin - 1.
  const std::int64_t before_wrap = std::min(fresh, period - begin);
  const auto add_run = [&](std::int64_t from, std::int64_t to, std::int64_t at) {
    if (from >= to) return;
    SamplingRun run(geometry_->tables, direction, with,
                    {static_cast<int>(from), static_cast<int>(to)},
                    {rows[0] + at, rows[1] + at, rows[2] + at, rows[3] + at});
    geometry_->add_to(run);
    run.finish();
  };
  add_run(begin, begin + before_wrap, 0);
  add_run(0, fresh - before_wrap, before_wrap);
  for (double* row : rows) repeat(row, period, count);
}

}  // namespace millstudy::force
