// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// Harmonics of one slice for each input that (F4) is linear in: one, sin(kappa), cos(kappa), r.
struct UnitSlices {
  std::array<Harmonics, 4> chip;
  std::array<Harmonics, 4> edge;
};

Harmonics unit_slice(const Combination& with, int input, double chip, double edge) {
  const auto slice = [&](double phi, double sin_kappa, double cos_kappa, double radius) {
    Basis<double> basis;
    const auto axes = edge_axes(std::sin(phi), std::cos(phi), sin_kappa, cos_kappa, radius);
    add_slice(basis, axes, chip * std::sin(phi), edge);
    return basis;
  };
  const HarmonicBasis basis([&](double phi) {
    Basis<double> unit = slice(phi, input == 1, input == 2, input == 3);
    if (input == 0) return unit;
    const Basis<double> rest = slice(phi, 0.0, 0.0, 0.0);
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        unit.chip[row][column] -= rest.chip[row][column];
        unit.edge[row][column] -= rest.edge[row][column];
      }
    }
    return unit;
  });
  return basis.combine(with);
}

UnitSlices unit_slices(const Combination& with) {
  UnitSlices units;
  for (int input = 0; input < 4; ++input) {
    units.chip[input] = unit_slice(with, input, 1.0, 0.0);
    units.edge[input] = unit_slice(with, input, 0.0, 1.0);
  }
  return units;
}

void add_scaled(Harmonics& sum, const Harmonics& term, double factor) {
  for (int row = 0; row < kRows; ++row) {
    sum.constant[row] += factor * term.constant[row];
    sum.cos1[row] += factor * term.cos1[row];
    sum.sin1[row] += factor * term.sin1[row];
    sum.cos2[row] += factor * term.cos2[row];
    sum.sin2[row] += factor * term.sin2[row];
  }
}

}  // namespace

DiscEdge::DiscEdge(const cutter::Cutter& cutter, const Engagement& engagement, int discs)
    : entry_angle_(engagement.entry_angle),
      exit_angle_(engagement.exit_angle),
      closed_(hand(cutter) > 0.0 ? Closed::above : Closed::below) {
  discs_.reserve(discs);
  for (int i = 0; i < discs; ++i) {
    const Disc disc = disc_at(cutter, engagement.axial_depth, discs, i);
    discs_.push_back({disc, std::cos(disc.lag_angle), std::sin(disc.lag_angle)});
  }
}

/// (F12), disc by disc: each is in cut over one range of angles a pass, so there is no gate in the
/// loop over angles.
void DiscEdge::add_to(SamplingRun& run) const {
  const UnitSlices units = unit_slices(run.with());
  for (const Turned& turned : discs_) {
    const Disc& disc = turned.disc;
    const std::array<double, 4> inputs = {1.0, disc.sin_kappa, disc.cos_kappa, disc.radius};
    Harmonics force;
    for (int input = 0; input < 4; ++input) {
      add_scaled(force, units.chip[input], disc.height * inputs[input]);
      add_scaled(force, units.edge[input], disc.edge_length * inputs[input]);
    }
    force = shifted(force, turned.cos_lag, -turned.sin_lag);
    const double from = entry_angle_ + disc.lag_angle;
    const double to = exit_angle_ + disc.lag_angle;
    run.for_each_pass(from, to, [&](const Pass& pass) {
      run.add(pass, run.between(pass, from, to, closed_), force);
    });
  }
}

}  // namespace millstudy::force
