// SPDX-License-Identifier: MIT
#include "force/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "force/gathered_nodes.h"
#include "force/slice.h"
#include "force/tooth_integral.h"

namespace millstudy::force {
namespace {

/// The chip over sin(kappa) at a point, (F22), of one reach, and its derivatives.
struct ChipAt {
  double value;
  double angle;
  double feed;
  std::array<double, 2> runout;
  double lag;  ///< along the edge
};

}  // namespace

/// One edge at one spindle angle under one reach.
struct ForceSensitivity::Tooth {
  const CuttingEdges& edges;
  const FittedCoefficients& coefficients;
  Sensitivity& sum;
  Feed feed;
  int flute;
  double tip_angle;

  // The tooth that left the surface.
  double tangent = edges.flutes()[flute].helix_tangent;
  double position = edges.flutes()[flute].position;
  double other_tangent = 0.0;
  double other_position = 0.0;     ///< ahead of flute 0, more than `position`
  std::array<double, 2> offset{};  ///< of the runout
  bool with_exponent = false;

  /// @param m  teeth since it passed, 1 .. N
  void follow(int m) {
    const std::vector<cutter::Flute>& flutes = edges.flutes();
    const auto count = static_cast<int>(flutes.size());
    const cutter::Flute& other = flutes[(flute + m) % count];
    other_tangent = other.helix_tangent;
    other_position = other.position + (flute + m >= count ? 2.0 * core::kPi : 0.0);
  }

  ChipAt chip(double lag, double sin_phi, double cos_phi) const {
    const double per_turn = static_cast<double>(edges.flutes().size()) / (2.0 * core::kPi);
    const double own = position - tangent * lag;
    const double before = other_position - other_tangent * lag;
    const double ratio = per_turn * (before - own);
    const double own_cos = std::cos(own), own_sin = std::sin(own);
    const double before_cos = std::cos(before), before_sin = std::sin(before);
    ChipAt at;
    at.runout = {own_cos - before_cos, own_sin - before_sin};
    at.feed = ratio * sin_phi;
    at.angle = ratio * feed.per_tooth * cos_phi;
    at.value = at.feed * feed.per_tooth + offset[0] * at.runout[0] + offset[1] * at.runout[1];
    at.lag = per_turn * (tangent - other_tangent) * feed.per_tooth * sin_phi - tangent * at.angle +
             offset[0] * (tangent * own_sin - other_tangent * before_sin) -
             offset[1] * (tangent * own_cos - other_tangent * before_cos);
    return at;
  }

  /// K of a column at a height.
  double k(int column, double z) const {
    return coefficients.k[column] + coefficients.k[6 + column] * z;
  }

  /// (F18)
  double size_effect(double h) const {
    const double m = coefficients.size_exponent;
    return m == 0.0 ? 1.0 : std::pow(h / coefficients.reference_chip_thickness, -m);
  }

  void add(const EdgeNode& node) {
    const double phi = tip_angle - tangent * node.lag;
    const double sin_phi = std::sin(phi), cos_phi = std::cos(phi);
    const ChipAt at = chip(node.lag, sin_phi, cos_phi);
    const double h = at.value * node.sin_kappa;
    if (h <= 0.0) return;
    const double size = size_effect(h);
    const double area = size * h * node.width;
    const double per_chip = size * (1.0 - coefficients.size_exponent) * node.width * node.sin_kappa;
    const Matrix43<double> axes =
        edge_axes(sin_phi, cos_phi, node.sin_kappa, node.cos_kappa, node.radius);
    std::array<double, 3> along{}, chips{};
    for (int c = 0; c < kColumns; ++c) {
      chips[c] = k(c, node.z);
      along[c] = chips[c] * area + k(kColumns + c, node.z) * node.length;
    }
    std::array<double, 3> force{}, grown{};
    for (int row = 0; row < 3; ++row) {
      for (int c = 0; c < kColumns; ++c) {
        const double axis = axes[row][c];
        sum.coefficient[c][row] += axis * area;
        sum.coefficient[kColumns + c][row] += axis * node.length;
        sum.coefficient[6 + c][row] += axis * area * node.z;
        sum.coefficient[9 + c][row] += axis * node.length * node.z;
        force[row] += axis * along[c];
        grown[row] += axis * chips[c];
      }
    }
    const std::array<double, 3> turned = {force[1], -force[0], 0.0};  // d axes / d phi
    const double log_size =
        with_exponent ? std::log(h / coefficients.reference_chip_thickness) : 0.0;
    for (int row = 0; row < 3; ++row) {
      const double growth = grown[row] * per_chip;
      sum.force[row] += force[row];
      sum.angle[row] += turned[row] + growth * at.angle;
      sum.feed[row] += growth * at.feed;
      sum.runout[0][row] += growth * at.runout[0];
      sum.runout[1][row] += growth * at.runout[1];
      sum.exponent[row] -= grown[row] * area * log_size;
    }
  }
  /// Integrand per node variable p at a height, and how fast the lag grows with p.
  struct Density {
    std::array<double, 3> force{};
    double lag_per_p = 0.0;
    ChipAt chip{};
  };

  Density density(const EdgePiece& piece, double z) const {
    Density out;
    const EdgeNode node = edges.node(piece, tangent, CuttingEdges::variable(piece, z), 1.0);
    const double phi = tip_angle - tangent * node.lag;
    const double sin_phi = std::sin(phi), cos_phi = std::cos(phi);
    out.chip = chip(node.lag, sin_phi, cos_phi);
    const double h = std::max(0.0, out.chip.value * node.sin_kappa);
    const double area = h == 0.0 ? 0.0 : size_effect(h) * h * node.width;
    const Matrix43<double> axes =
        edge_axes(sin_phi, cos_phi, node.sin_kappa, node.cos_kappa, node.radius);
    for (int row = 0; row < 3; ++row) {
      for (int c = 0; c < kColumns; ++c) {
        out.force[row] +=
            axes[row][c] * (k(c, node.z) * area + k(kColumns + c, node.z) * node.length);
      }
    }
    out.lag_per_p = edges.envelope().lag_slope(node.z) * node.sin_kappa * node.width;
    return out;
  }

  /// A limit at a fixed immersion angle moves up the edge as the spindle turns.
  /// @param side  +1 for the upper end of a stretch, -1 for the lower
  void add_arc_limit(const EdgePiece& piece, double z, double side) {
    const Density at = density(piece, z);
    const double moves = tangent * at.lag_per_p;
    if (moves == 0.0) return;
    for (int row = 0; row < 3; ++row) sum.angle[row] += side * at.force[row] / moves;
  }

  /// Where the chip vanishes, the edge force goes with it.
  void add_chip_limit(const EdgePiece& piece, double z, double side) {
    const Density at = density(piece, z);
    const double slope = at.chip.lag * at.lag_per_p;
    if (slope == 0.0) return;
    for (int row = 0; row < 3; ++row) {
      const double jump = -side * at.force[row] / slope;
      sum.angle[row] += jump * at.chip.angle;
      sum.feed[row] += jump * at.chip.feed;
      sum.runout[0][row] += jump * at.chip.runout[0];
      sum.runout[1][row] += jump * at.chip.runout[1];
    }
  }
};

ForceSensitivity::ForceSensitivity(const cutter::Cutter& cutter, const Engagement& engagement,
                                   bool gather)
    : edges_(cutter, engagement.axial_depth, {}),
      law_(edges_),
      arc_(engagement.arc()),
      gather_(gather),
      reaches_(law_.reaches()) {
  if (cutter.runout.tilt != 0.0) {
    throw core::InputError("runout tilt must be 0 here: derivatives are those of parallel axes");
  }
}

void ForceSensitivity::add_interval(Tooth& tooth, double z1, double z2) {
  for (const EdgePiece& piece : edges_.pieces()) {
    const double from = std::max(z1, piece.bottom);
    const double to = std::min(z2, piece.top);
    if (from >= to) continue;
    find_regimes(edges_, law_, tooth.feed, tooth.flute, piece, tooth.tip_angle, from, to, regimes_);
    for (std::size_t i = 0; i < regimes_.size(); ++i) {
      const Regime& regime = regimes_[i];
      const double middle = 0.5 * (regime.bottom + regime.top);
      const double lag = edges_.envelope().lag(middle);
      law_.find(tooth.flute, middle, lag, reaches_);
      const double sin_phi = std::sin(tooth.tip_angle - tooth.tangent * lag);
      const auto smallest =
          std::min_element(reaches_.begin(), reaches_.end(), [&](const Reach& a, const Reach& b) {
            return ChipLaw::reach_over(a, tooth.feed, sin_phi, 1.0, 0.0) <
                   ChipLaw::reach_over(b, tooth.feed, sin_phi, 1.0, 0.0);
          });
      tooth.follow(static_cast<int>(smallest - reaches_.begin()) + 1);
      const auto add = [&](const EdgeNode& node) { tooth.add(node); };
      if (gather_) {
        for_each_gathered_node(edges_, piece, tooth.tangent, regime.bottom, regime.top, add);
      } else {
        edges_.for_each_node(piece, tooth.tangent, regime.bottom, regime.top, add);
      }
      // Where tooth and tooth cross, and where pieces join, what one side loses the other gains.
      if (regime.bottom == from) {
        if (from == z1 && z1 > 0.0) tooth.add_arc_limit(piece, from, -1.0);
      } else if (i == 0 || regimes_[i - 1].top != regime.bottom) {
        tooth.add_chip_limit(piece, regime.bottom, -1.0);
      }
      if (regime.top == to) {
        if (to == z2 && z2 < edges_.axial_depth()) tooth.add_arc_limit(piece, to, 1.0);
      } else if (i + 1 == regimes_.size() || regimes_[i + 1].bottom != regime.top) {
        tooth.add_chip_limit(piece, regime.top, 1.0);
      }
    }
  }
}

Sensitivity ForceSensitivity::at(double angle, double feed_per_tooth,
                                 const FittedCoefficients& coefficients) {
  Sensitivity sum;
  const cutter::Runout& runout = edges_.cutter().runout;
  for (std::size_t j = 0; j < edges_.flutes().size(); ++j) {
    const cutter::Flute& flute = edges_.flutes()[j];
    Tooth tooth{edges_,
                coefficients,
                sum,
                {feed_per_tooth, 0.0, 0.0},
                static_cast<int>(j),
                angle + flute.position};
    tooth.offset = {runout.offset * std::cos(runout.angle), runout.offset * std::sin(runout.angle)};
    tooth.with_exponent = gather_;
    for_each_engaged_interval(edges_, flute.helix_tangent, arc_, tooth.tip_angle,
                              [&](double z1, double z2) { add_interval(tooth, z1, z2); });
  }
  return sum;
}

}  // namespace millstudy::force
