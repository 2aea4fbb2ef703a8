// SPDX-License-Identifier: MIT
#include "force/chip_thickness.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "cutter/envelope.h"
#include "force/chip_law.h"

namespace millstudy::force {
namespace {

/// Largest f over a .. b, by golden sections about the best of a scan.
template <class Function>
double largest_over(double a, double b, const Function& f) {
  constexpr int kScan = 32;
  constexpr int kSections = 30;
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto at = [&](int i) { return a + (b - a) * i / kScan; };
  int best = 0;
  double largest = f(a);
  for (int i = 1; i <= kScan; ++i) {
    if (const double value = f(at(i)); value > largest) {
      largest = value;
      best = i;
    }
  }
  double low = at(std::max(0, best - 1)), high = at(std::min(kScan, best + 1));
  for (int i = 0; i < kSections; ++i) {
    const double left = high - ratio * (high - low), right = low + ratio * (high - low);
    const double at_left = f(left), at_right = f(right);
    largest = std::max({largest, at_left, at_right});
    (at_left > at_right ? high : low) = at_left > at_right ? right : left;
  }
  return largest;
}

}  // namespace

double largest_sine(std::span<const Arc> arcs) {
  double largest = 0.0;
  for (const Arc& arc : arcs) {
    const double steepest = std::clamp(0.5 * core::kPi, arc.entry_angle, arc.exit_angle);
    largest = std::max(largest, std::sin(steepest));
  }
  return largest;
}

std::vector<double> largest_chip_thickness(const CuttingEdges& edges, double sin_phi,
                                           const Feed& feed) {
  const ChipLaw law(edges);
  const bool closed = law.reaches() == 1 && !edges.variable_helix() && feed.slope == 0.0;
  std::vector<double> thickest;
  std::vector<Reach> reaches(law.reaches());
  for (int flute = 0; flute < static_cast<int>(edges.flutes().size()); ++flute) {
    if (closed) {
      const double sin_kappa = cutter::largest_sin_kappa(edges.envelope(), edges.axial_depth());
      thickest.push_back(feed.per_tooth * edges.pitch_ratio(flute, 0.0) * sin_phi * sin_kappa);
      continue;
    }
    double largest = 0.0;
    for (const EdgePiece& piece : edges.pieces()) {
      const double found = largest_over(piece.bottom, piece.top, [&](double z) {
        const double kappa = piece.segment.kappa_at(z);
        law.find(flute, edge_point(edges.envelope(), edges.flutes()[flute].helix_tangent, z),
                 reaches);
        return ChipLaw::thickness(reaches, feed, sin_phi, std::sin(kappa), std::cos(kappa));
      });
      largest = std::max(largest, found);
    }
    thickest.push_back(largest);
  }
  return thickest;
}

}  // namespace millstudy::force
