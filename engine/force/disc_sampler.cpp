// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <utility>

#include "force/prepared_edges.h"
#include "force/tooth_integral.h"

namespace millstudy::force {

DiscEdge::DiscEdge(std::shared_ptr<const CuttingEdges> edges, Rows rows, int flute, int discs)
    : edges_(std::move(edges)),
      rows_(rows),
      flute_(flute),
      closed_(hand(edges_->flutes()[flute].helix_tangent) > 0.0 ? Closed::above : Closed::below) {
  const double tangent = edges_->flutes()[flute].helix_tangent;
  discs_.reserve(discs);
  for (int i = 0; i < discs; ++i) {
    const EdgeNode node = edges_->disc(tangent, discs, i);
    discs_.push_back({node, Angle(tangent * node.lag)});
  }
}

namespace {

/// Harmonics from rows of forces at the five angles.
Harmonics harmonics_of(const std::array<std::array<double, kRows>, kHarmonics>& samples) {
  const HarmonicAngles& angles = HarmonicAngles::get();
  Harmonics p;
  const std::array<Harmonics::Row*, kHarmonics> parts = {&p.constant, &p.cos1, &p.sin1, &p.cos2,
                                                         &p.sin2};
  for (int h = 0; h < kHarmonics; ++h) {
    for (int i = 0; i < kHarmonics; ++i) {
      for (int row = 0; row < kRows; ++row) {
        (*parts[h])[row] += angles.weight[h][i] * samples[i][row];
      }
    }
  }
  return p;
}

}  // namespace

/// (F12), disc by disc: each is in cut over one range of angles a pass, so there is no gate in the
/// loop over angles.
void DiscEdge::add_to(SamplingRun& run, const Combination& with, const Arc& arc) const {
  const HarmonicAngles& angles = HarmonicAngles::get();
  for (const Disc& disc : discs_) {
    std::array<std::array<double, kRows>, kHarmonics> samples;
    for (int i = 0; i < kHarmonics; ++i) {
      Basis<double> basis;
      add_node(basis, *edges_, rows_, flute_, disc.node, angles.sine[i], angles.cosine[i]);
      samples[i] = force_of(basis, with.load);
      with.turn(samples[i].data());
    }
    const Harmonics force = shifted(harmonics_of(samples), disc.lag.cosine, -disc.lag.sine);
    const double from = arc.entry_angle + disc.lag.value;
    const double to = arc.exit_angle + disc.lag.value;
    run.for_each_pass(from, to, [&](const Pass& pass) {
      run.add(pass, run.between(pass, from, to, closed_), force);
    });
  }
}

}  // namespace millstudy::force
