// SPDX-License-Identifier: MIT
#include "force/sampler.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/units.h"
#include "core/watch.h"
#include "force/lanes.h"
#include "force/nonlinear_force.h"
#include "force/prepared_edges.h"
#include "force/runout_edges.h"
#include "force/sampling_run.h"

namespace millstudy::force {
namespace {

constexpr int kMostAngularSteps = 10'000'000;
constexpr int kAllFlutes = -1;

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

/// The cutter without what pitch does to it: one flute of it stands for all that have its helix
/// angle.
cutter::Cutter plain(cutter::Cutter cutter) {
  if (cutter::has_variable_helix(cutter)) return cutter;
  cutter.pitch_angles.clear();
  return cutter;
}

/// The prepared edge of one tooth.
struct ToothGeometry {
  ToothGeometry(const std::shared_ptr<const CuttingEdges>& edges, Rows rows, int flute,
                const EdgeRule& edge_rule) {
    if (edge_rule.rule == Rule::discs) {
      discs.emplace(edges, rows, flute, edge_rule.discs);
      return;
    }
    const bool closed_form =
        rows == Rows::forces && !edges->variable_helix() && !edges->variation().with_height();
    if (edges->variation().with_exponent()) return;  // is prepared for an arc: Engaged
    for (const EdgePiece& piece : edges->pieces()) {
      if (closed_form && piece.segment.is_cylinder()) {
        cylinders.emplace_back(*edges, flute, piece);
      } else {
        add_series(*edges, rows, flute, piece);
      }
    }
  }

  /// A cylinder comes in one piece of any length, for its closed form; where that does not serve,
  /// as for moments, it is cut until its series can resolve the turns of the helix.
  void add_series(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece) {
    constexpr double kLongest = 3.0;  // [rad] of lag
    const double tangent = edges.flutes()[flute].helix_tangent;
    const int parts =
        piece.segment.is_cylinder()
            ? 1 + static_cast<int>(edges.span(piece, tangent, piece.bottom, piece.top) / kLongest)
            : 1;
    EdgePiece part = piece;
    for (int i = 1; i <= parts; ++i) {
      part.top = i == parts ? piece.top : piece.bottom + (piece.top - piece.bottom) * i / parts;
      series.emplace_back(edges, rows, flute, part);
      part.bottom = part.top;
    }
  }

  std::vector<SeriesEdge> series;
  std::vector<CylinderEdge> cylinders;
  std::optional<DiscEdge> discs;
};

/// A tooth, or a set of equal ones.
struct Tooth {
  std::size_t geometry;
  Angle position;
  double pitch_ratio;
};

}  // namespace

void ForceSamples::resize(std::size_t count) {
  for (std::vector<double>* row : {&x, &y, &z, &torque}) row->resize(count);
}

struct ForceSampler::Geometry {
  Geometry(const cutter::Cutter& cutter, double axial_depth, const EdgeRule& edge_rule, int steps,
           const Variation& variation, Rows row_kind)
      : angular_steps(steps),
        rows(row_kind),
        edges(std::make_shared<const CuttingEdges>(cutter, axial_depth, variation)),
        plain_edges(std::make_shared<const CuttingEdges>(plain(cutter), axial_depth, variation)),
        nonlinear(edges, edge_rule),
        tables(steps, edges->equal_flutes() ? cutter.flutes : 1),
        linear(can_be_linear(edge_rule)),
        size_effect(variation.with_exponent()),
        runout(*edges, *plain_edges, rows, edge_rule) {
    for (const EdgePiece& piece : edges->pieces()) {
      for (const double z : {piece.bottom, piece.top}) {
        const double kappa = piece.segment.kappa_at(z);
        const double cosine = piece.segment.is_cylinder() ? 0.0 : std::cos(kappa);
        lowest_cos_kappa = std::min(lowest_cos_kappa, cosine);
        highest_cos_kappa = std::max(highest_cos_kappa, cosine);
      }
    }
    if (!linear) return;
    const int kinds = edges->variable_helix() ? cutter.flutes : 1;
    for (int flute = 0; flute < kinds; ++flute) {
      geometries.emplace_back(plain_edges, rows, flute, edge_rule);
    }
    for (int flute = 0; flute < cutter.flutes; ++flute) {
      const bool own = edges->variable_helix();  // its geometry then has its pitch
      teeth.push_back({own ? static_cast<std::size_t>(flute) : 0,
                       Angle(edges->flutes()[flute].position),
                       own ? 1.0 : edges->pitch_ratio(flute, 0.0)});
    }
  }

  bool can_be_linear(const EdgeRule& edge_rule) const {
    const Variation& law = edges->variation();
    const bool power = law.with_exponent() && !law.orthogonal && edge_rule.rule == Rule::exact;
    return !cutter::has_runout(edges->cutter()) && (power || !law.with_chip());
  }

  int angular_steps;
  Rows rows;
  std::shared_ptr<const CuttingEdges> edges;
  std::shared_ptr<const CuttingEdges> plain_edges;
  NonlinearForce nonlinear;
  AngleTables tables;  ///< of all teeth

  bool linear;       ///< each flute sees a chip in proportion to the feed, or to a power of it
  bool size_effect;  ///< it is a power
  double lowest_cos_kappa = 0.0;  ///< of the edge, 0 included
  double highest_cos_kappa = 0.0;
  std::vector<ToothGeometry> geometries;
  std::vector<Tooth> teeth;
  RunoutEdges runout;
};

/// What of the geometry depends on the arcs.
struct ForceSampler::Engaged {
  /// @param first  of a sampler that is made anew: worth the milliseconds of a size effect's series
  Engaged(const Geometry& g, std::span<const Arc> all, bool first)
      : arcs(all.begin(), all.end()), size_effect_is_prepared(first) {
    for (const Arc& arc : arcs) {
      for (std::size_t i = 0; i < g.geometries.size(); ++i) {
        series.emplace_back();
        power_edges.emplace_back();
        cylinders.emplace_back();
        for (const SeriesEdge& edge : g.geometries[i].series) series.back().push_back(edge.at(arc));
        for (const CylinderEdge& edge : g.geometries[i].cylinders) {
          cylinders.back().push_back(edge.at(arc));
        }
        if (!g.size_effect || !first) continue;
        for (const EdgePiece& piece : g.plain_edges->pieces()) {
          power_edges.back().emplace_back(*g.plain_edges, g.rows, static_cast<int>(i), piece, arc);
          size_effect_is_prepared &= power_edges.back().back().is_resolved();
        }
      }
    }
  }

  void add_to(SamplingRun& run, const Geometry& g, const Tooth& tooth,
              const Combination& all) const {
    const Combination with = all.with_chip(tooth.pitch_ratio, g.edges->variation().size_exponent);
    const ToothGeometry& edge = g.geometries[tooth.geometry];
    run.begin_tooth(tooth.position);
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      const std::size_t at = a * g.geometries.size() + tooth.geometry;
      for (std::size_t i = 0; i < series[at].size(); ++i) {
        edge.series[i].add_to(run, with, series[at][i]);
      }
      for (const SizeEffectEdge& power : power_edges[at]) power.add_to(run, with);
      for (std::size_t i = 0; i < cylinders[at].size(); ++i) {
        edge.cylinders[i].add_to(run, with, cylinders[at][i]);
      }
      if (edge.discs) edge.discs->add_to(run, with, arcs[a]);
    }
  }

  std::vector<Arc> arcs;
  bool size_effect_is_prepared;
  std::vector<std::vector<SeriesEdge::AtArc>> series;       ///< shape (arcs, geometries)
  std::vector<std::vector<CylinderEdge::AtArc>> cylinders;  ///< likewise
  std::vector<std::vector<SizeEffectEdge>> power_edges;     ///< likewise
};

ForceSampler::ForceSampler(const cutter::Cutter& cutter, const Engagement& engagement,
                           const EdgeRule& edge_rule, int angular_steps, const Variation& variation,
                           bool with_moments) {
  checked_steps(angular_steps);
  cutter::check(cutter);
  check(cutter, engagement);
  check(edge_rule);
  check(variation);
  const Arc arc = engagement.arc();
  const auto prepare = [&](ForceSampler& sampler, Rows rows) {
    sampler.geometry_ = std::make_shared<const Geometry>(cutter, engagement.axial_depth, edge_rule,
                                                         angular_steps, variation, rows);
    sampler.engaged_ =
        std::make_shared<const Engaged>(*sampler.geometry_, std::span(&arc, 1), true);
  };
  prepare(*this, Rows::forces);
  if (!with_moments) return;
  ForceSampler moments;
  prepare(moments, Rows::moments);
  moments_ = std::make_shared<const ForceSampler>(std::move(moments));
}

ForceSampler ForceSampler::with_arcs(std::span<const Arc> arcs) const {
  for (const Arc& arc : arcs) check(arc);
  ForceSampler other = *this;
  other.engaged_ = std::make_shared<const Engaged>(*geometry_, arcs, false);
  if (moments_) other.moments_ = std::make_shared<const ForceSampler>(moments_->with_arcs(arcs));
  return other;
}

int ForceSampler::angular_steps() const {
  return geometry_->angular_steps;
}

std::span<const Arc> ForceSampler::arcs() const {
  return engaged_->arcs;
}

const CuttingEdges& ForceSampler::edges() const {
  return *geometry_->edges;
}

void ForceSampler::sample_moments(const Coefficients& coefficients, const Feed& feed,
                                  std::int64_t first, std::int64_t count, ForceSamples& out) const {
  assert(moments_);
  moments_->sample(coefficients, feed, first, count, out);
}

bool ForceSampler::is_linear(const Feed& feed) const {
  const Geometry& g = *geometry_;
  if (!g.linear) return false;
  if (g.size_effect) return engaged_->size_effect_is_prepared && feed.slope == 0.0;
  // A side of the edge that the feed upward leaves may have no chip: the lower one of a climbing
  // tool, the undercut of a falling one.
  const double up = feed.upward();
  return up * g.highest_cos_kappa <= 0.0 && up * g.lowest_cos_kappa <= 0.0;
}

void ForceSampler::sample(const Coefficients& coefficients, const Feed& feed, std::int64_t first,
                          std::int64_t count, ForceSamples& out) const {
  sample_flute(kAllFlutes, coefficients, feed, first, count, out);
}

void ForceSampler::sample_flute(int flute, const Coefficients& coefficients, const Feed& feed,
                                std::int64_t first, std::int64_t count, ForceSamples& out) const {
  geometry_->runout.serve(feed) || is_linear(feed)
      ? sample_prepared(flute, coefficients, feed, first, count, out)
      : sample_nonlinear(flute, coefficients, feed, first, count, out);
}

void ForceSampler::add_to(SamplingRun& run, int flute, const Coefficients& coefficients,
                          const Feed& feed) const {
  const Geometry& g = *geometry_;
  if (g.runout.serve(feed)) {
    const int from = flute == kAllFlutes ? 0 : flute;
    const int to = flute == kAllFlutes ? g.edges->cutter().flutes - 1 : flute;
    g.runout.add_to(run, *g.edges, from, to, coefficients, feed, engaged_->arcs);
    return;
  }
  Loads load = loads(coefficients, feed);
  const Variation& variation = g.edges->variation();
  for (int q = 0; g.size_effect && q < kColumns;
       ++q) {  // (F18): K h (h/h0)^-m = K f (f/h0)^-m (h/f)^(1-m)
    const double m = variation.size_exponent[q];
    if (m != 0.0) load[q] *= std::pow(feed.per_tooth / variation.reference_chip_thickness, -m);
  }
  const Combination with = {load, run.direction().cosine, run.direction().sine, feed.slope != 0.0};
  if (flute != kAllFlutes) {
    engaged_->add_to(run, g, g.teeth[flute], with);
  } else if (run.tables().teeth > 1) {
    engaged_->add_to(run, g, g.teeth[0], with);  // one stands for all
  } else {
    for (const Tooth& tooth : g.teeth) engaged_->add_to(run, g, tooth, with);
  }
}

void ForceSampler::sample_prepared(int flute, const Coefficients& coefficients, const Feed& feed,
                                   std::int64_t first, std::int64_t count,
                                   ForceSamples& out) const {
  std::optional<AngleTables> single;  // of one flute, where the geometry has those of all
  if (flute != kAllFlutes && geometry_->tables.teeth > 1) {
    single.emplace(geometry_->angular_steps, 1);
  }
  const AngleTables& tables = single ? *single : geometry_->tables;
  const std::int64_t period = tables.period;
  // Whole vectors are written, so there must be room for one that begins at the last sample.
  const std::size_t room = count + kLanes;
  if (out.x.size() < room) out.resize(room);
  const std::array<double*, kRows> rows = {out.x.data(), out.y.data(), out.z.data(),
                                           out.torque.data()};
  const Angle direction(std::remainder(feed.direction, core::kTurn));
  const std::int64_t begin = ((first % period) + period) % period;
  const std::int64_t fresh = std::min(count, period);
  // The samples of one period are begin .. period - 1 and then 0 .. begin - 1.
  const std::int64_t before_wrap = std::min(fresh, period - begin);
  const auto add_run = [&](std::int64_t from, std::int64_t to, std::int64_t at) {
    if (from >= to) return;
    SamplingRun run(tables, direction, {static_cast<int>(from), static_cast<int>(to)},
                    {rows[0] + at, rows[1] + at, rows[2] + at, rows[3] + at});
    add_to(run, flute, coefficients, feed);
    run.finish();
  };
  add_run(begin, begin + before_wrap, 0);
  add_run(0, fresh - before_wrap, before_wrap);
  for (double* row : rows) repeat(row, period, count);
}

void ForceSampler::sample_nonlinear(int flute, const Coefficients& coefficients, const Feed& feed,
                                    std::int64_t first, std::int64_t count,
                                    ForceSamples& out) const {
  const Geometry& g = *geometry_;
  const std::int64_t steps = g.angular_steps;
  if (out.x.size() < static_cast<std::size_t>(count) + kLanes) out.resize(count + kLanes);
  const double direction = std::remainder(feed.direction, core::kTurn);
  const double c = std::cos(direction), s = std::sin(direction);
  const int begin = flute == kAllFlutes ? 0 : flute;
  const int end = flute == kAllFlutes ? g.edges->cutter().flutes : flute + 1;
  const std::int64_t fresh = std::min(count, steps);
  for (std::int64_t i = 0; i < fresh; ++i) {
    if (i % 16 == 0) core::keep_watch();
    const std::int64_t n = (((first + i) % steps) + steps) % steps;
    const double phi =
        core::kTurn * static_cast<double>(n) / static_cast<double>(steps) + direction;
    std::array<double, kRows> sum{};
    for (int j = begin; j < end; ++j) {
      const std::array<double, kRows> force = g.nonlinear.of_flute(
          j, phi + g.edges->flutes()[j].position, engaged_->arcs, coefficients, feed, g.rows);
      for (int row = 0; row < kRows; ++row) sum[row] += force[row];
    }
    out.x[i] = sum[0] * c - sum[1] * s;
    out.y[i] = sum[0] * s + sum[1] * c;
    out.z[i] = sum[2];
    out.torque[i] = sum[3];
  }
  for (std::vector<double>* row : {&out.x, &out.y, &out.z, &out.torque}) {
    repeat(row->data(), steps, count);
  }
}

}  // namespace millstudy::force
