// SPDX-License-Identifier: MIT
#include "force/sensitivity.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "force/gathered_nodes.h"
#include "force/slice.h"
#include "force/stretch_moments.h"
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

std::array<double, 2> direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

/// One edge at one spindle angle under one reach.
struct ForceSensitivity::Tooth {
  const CuttingEdges& edges;
  const FittedCoefficients& coefficients;
  Sensitivity& sum;
  Feed feed;
  int flute;
  double tip_angle;

  const std::vector<std::array<double, 2>>& tips;  ///< cos and sin of the positions of the flutes
  double tangent = edges.flutes()[flute].helix_tangent;
  double position = edges.flutes()[flute].position;
  // The tooth that left the surface.
  int other = 0;
  double other_tangent = 0.0;
  double other_position = 0.0;     ///< ahead of flute 0, more than `position`
  std::array<double, 2> offset{};  ///< of the runout
  bool with_exponent = false;
  double cos_tip = 0.0;
  double sin_tip = 0.0;

  /// @param m  teeth since it passed, 1 .. N
  void follow(int m) {
    const std::vector<cutter::Flute>& flutes = edges.flutes();
    const auto count = static_cast<int>(flutes.size());
    other = (flute + m) % count;
    other_tangent = flutes[other].helix_tangent;
    other_position = flutes[other].position + (flute + m >= count ? core::kTurn : 0.0);
  }

  /// cos and sin of an angle less the lag angle.
  static std::array<double, 2> behind(double cosine, double sine,
                                      const std::array<double, 2>& lag) {
    return {cosine * lag[0] + sine * lag[1], sine * lag[0] - cosine * lag[1]};
  }

  ChipAt chip(double lag, const std::array<double, 2>& own_lag, double sin_phi,
              double cos_phi) const {
    const double per_turn = static_cast<double>(edges.flutes().size()) / core::kTurn;
    const double own = position - tangent * lag;
    const double before = other_position - other_tangent * lag;
    const double ratio = per_turn * (before - own);
    const auto [own_cos, own_sin] = behind(tips[flute][0], tips[flute][1], own_lag);
    const auto [before_cos, before_sin] =
        behind(tips[other][0], tips[other][1],
               other_tangent == tangent ? own_lag : direction(other_tangent * lag));
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

  /// ln(h / h0), of which (F18) is the exponential.
  double log_of(double h) const {
    return with_exponent ? std::log(h / coefficients.reference_chip_thickness) : 0.0;
  }
  double size_effect(double log_size) const {
    return with_exponent ? std::exp(-coefficients.size_exponent * log_size) : 1.0;
  }

  void add(const EdgeNode& node) {
    const std::array<double, 2> lag = direction(tangent * node.lag);
    const auto [cos_phi, sin_phi] = behind(cos_tip, sin_tip, lag);
    const ChipAt at = chip(node.lag, lag, sin_phi, cos_phi);
    const double h = at.value * node.sin_kappa;
    if (h <= 0.0) return;
    const double log_size = log_of(h), size = size_effect(log_size);
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
  /// (F31): a whole stretch of an edge, all flutes of one helix, no size effect.
  void add(const MomentPair& moments, const ChipLine& line, bool with_slopes) {
    for (int power = 0; power < 2; ++power) {  // of z
      if (power == 1 && !with_slopes) break;
      const double* k = &coefficients.k[6 * power];
      const UnitForces by_a = chip_forces(moments[power], 1.0, 0.0, cos_tip, sin_tip);
      const UnitForces by_b = chip_forces(moments[power], 0.0, 1.0, cos_tip, sin_tip);
      const UnitForces edge = edge_forces(moments[power], cos_tip, sin_tip);
      std::array<double, 3> of_a{}, of_b{}, force{};
      for (int c = 0; c < kColumns; ++c) {
        for (int row = 0; row < 3; ++row) {
          const double chip = line.a * by_a[c][row] + line.b * by_b[c][row];
          sum.coefficient[6 * power + c][row] += chip;
          sum.coefficient[6 * power + kColumns + c][row] += edge[c][row];
          of_a[row] += k[c] * by_a[c][row];
          of_b[row] += k[c] * by_b[c][row];
          force[row] += k[c] * chip + k[kColumns + c] * edge[c][row];
        }
      }
      const double ratio = line.ratio;
      const double by_angle_a = ratio * feed.per_tooth * cos_tip;
      const double by_angle_b = ratio * feed.per_tooth * sin_tip;
      const std::array<double, 3> turned = {force[1], -force[0], 0.0};
      for (int row = 0; row < 3; ++row) {
        sum.force[row] += force[row];
        sum.angle[row] += turned[row] + of_a[row] * by_angle_a + of_b[row] * by_angle_b;
        sum.feed[row] += ratio * (of_a[row] * sin_tip - of_b[row] * cos_tip);
        sum.runout[0][row] += of_a[row] * line.cosines + of_b[row] * line.sines;
        sum.runout[1][row] += of_a[row] * line.sines - of_b[row] * line.cosines;
      }
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
    const std::array<double, 2> lag = direction(tangent * node.lag);
    const auto [cos_phi, sin_phi] = behind(cos_tip, sin_tip, lag);
    out.chip = chip(node.lag, lag, sin_phi, cos_phi);
    const double h = std::max(0.0, out.chip.value * node.sin_kappa);
    const double area = h == 0.0 ? 0.0 : size_effect(log_of(h)) * h * node.width;
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
                                   Wanted wanted)
    : edges_(cutter, engagement.axial_depth, {}),
      law_(edges_),
      arc_(engagement.arc()),
      wanted_(wanted),
      by_lines_(!edges_.variable_helix()),
      by_moments_(by_lines_ && !wanted.size_effect),
      lines_(law_.reaches()),
      reaches_(law_.reaches()) {
  if (cutter.runout.tilt != 0.0) {
    throw core::InputError("runout tilt must be 0 here: derivatives are those of parallel axes");
  }
  const cutter::Runout& runout = cutter.runout;
  offset_ = {runout.offset * std::cos(runout.angle), runout.offset * std::sin(runout.angle)};
  for (const cutter::Flute& flute : edges_.flutes()) {
    tips_.push_back(direction(flute.position));
  }
  if (!by_lines_) return;
  const double tangent = edges_.flutes().front().helix_tangent;
  for (const EdgePiece& piece : edges_.pieces()) {
    ends_.push_back({edge_point(edges_.envelope(), tangent, piece.bottom),
                     edge_point(edges_.envelope(), tangent, piece.top)});
    if (!by_moments_) continue;
    whole_.push_back(moments_of(edges_, piece, tangent, piece.bottom, piece.top, wanted.slopes));
  }
}

/// The reach that decides the chip at a height.
int ForceSensitivity::smallest_at(const Tooth& tooth, double z) {
  const EdgePoint point = edge_point(edges_.envelope(), tooth.tangent, z);
  law_.find(tooth.flute, point, reaches_);
  const double sin_phi = std::sin(tooth.tip_angle - tooth.tangent * point.lag);
  const auto value = [&](const Reach& reach) {
    return ChipLaw::reach_over(reach, tooth.feed, sin_phi, 1.0, 0.0);
  };
  const auto smallest =
      std::min_element(reaches_.begin(), reaches_.end(),
                       [&](const Reach& a, const Reach& b) { return value(a) < value(b); });
  return static_cast<int>(smallest - reaches_.begin());
}

void ForceSensitivity::add_by_nodes(Tooth& tooth, const EdgePiece& piece, const Regime& regime) {
  const auto add = [&](const EdgeNode& node) { tooth.add(node); };
  if (wanted_.size_effect) {
    for_each_gathered_node(edges_, piece, tooth.tangent, regime.bottom, regime.top, add);
  } else {
    edges_.for_each_node(piece, tooth.tangent, regime.bottom, regime.top, add);
  }
}

void ForceSensitivity::search_stretches(const Tooth& tooth, const EdgePiece& piece, double from,
                                        double to) {
  find_regimes(edges_, law_, tooth.feed, tooth.flute, piece, tooth.tip_angle, from, to, regimes_);
  stretches_.clear();
  for (const Regime& regime : regimes_) {
    stretches_.push_back({regime, smallest_at(tooth, 0.5 * (regime.bottom + regime.top))});
  }
}

void ForceSensitivity::add_interval(Tooth& tooth, double z1, double z2) {
  for (std::size_t q = 0; q < edges_.pieces().size(); ++q) {
    const EdgePiece& piece = edges_.pieces()[q];
    const double from = std::max(z1, piece.bottom);
    const double to = std::min(z2, piece.top);
    if (from >= to) continue;
    if (by_lines_) {
      const auto point = [&](double z) { return edge_point(edges_.envelope(), tooth.tangent, z); };
      find_lowest(edges_.envelope(), tooth.tangent, lines_,
                  from == piece.bottom ? ends_[q][0] : point(from),
                  to == piece.top ? ends_[q][1] : point(to), stretches_);
    } else {
      search_stretches(tooth, piece, from, to);
    }
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
      const auto& [regime, reach] = stretches_[i];
      tooth.follow(reach + 1);
      if (by_moments_) {
        const bool whole = regime.bottom == piece.bottom && regime.top == piece.top;
        tooth.add(whole ? whole_[q]
                        : moments_of(edges_, piece, tooth.tangent, regime.bottom, regime.top,
                                     wanted_.slopes),
                  lines_[reach], wanted_.slopes);
      } else {
        add_by_nodes(tooth, piece, regime);
      }
      // Where tooth and tooth cross, and where pieces join, what one side loses the other gains.
      if (regime.bottom == from) {
        if (from == z1 && z1 > 0.0) tooth.add_arc_limit(piece, from, -1.0);
      } else if (i == 0 || stretches_[i - 1].regime.top != regime.bottom) {
        tooth.add_chip_limit(piece, regime.bottom, -1.0);
      }
      if (regime.top == to) {
        if (to == z2 && z2 < edges_.axial_depth()) tooth.add_arc_limit(piece, to, 1.0);
      } else if (i + 1 == stretches_.size() || stretches_[i + 1].regime.bottom != regime.top) {
        tooth.add_chip_limit(piece, regime.top, 1.0);
      }
    }
  }
}

/// What does not change along the edge of the flute at hand, (F23) where it holds.
void ForceSensitivity::begin(Tooth& tooth) {
  tooth.sin_tip = std::sin(tooth.tip_angle);
  tooth.cos_tip = std::cos(tooth.tip_angle);
  if (!by_lines_) return;
  const std::vector<cutter::Flute>& flutes = edges_.flutes();
  const auto count = static_cast<int>(flutes.size());
  const double own = flutes[tooth.flute].position;
  for (int m = 1; m <= law_.reaches(); ++m) {
    ChipLine& line = lines_[m - 1];
    const int other = (tooth.flute + m) % count;
    const double turn = tooth.flute + m >= count ? core::kTurn : 0.0;
    line.ratio = (flutes[other].position + turn - own) * count / core::kTurn;
    line.cosines = tips_[tooth.flute][0] - tips_[other][0];
    line.sines = tips_[tooth.flute][1] - tips_[other][1];
    line.a = line.ratio * tooth.feed.per_tooth * tooth.sin_tip + tooth.offset[0] * line.cosines +
             tooth.offset[1] * line.sines;
    line.b = -line.ratio * tooth.feed.per_tooth * tooth.cos_tip + tooth.offset[0] * line.sines -
             tooth.offset[1] * line.cosines;
  }
}

Sensitivity ForceSensitivity::at(double angle, double feed_per_tooth,
                                 const FittedCoefficients& coefficients) {
  assert(wanted_.size_effect || coefficients.size_exponent == 0.0);
  Sensitivity sum;
  for (std::size_t j = 0; j < edges_.flutes().size(); ++j) {
    const cutter::Flute& flute = edges_.flutes()[j];
    Tooth tooth{edges_,
                coefficients,
                sum,
                {feed_per_tooth, 0.0, 0.0},
                static_cast<int>(j),
                angle + flute.position,
                tips_};
    tooth.offset = offset_;
    tooth.with_exponent = wanted_.size_effect;
    bool begun = false;
    for_each_engaged_interval(edges_, flute.helix_tangent, arc_, tooth.tip_angle,
                              [&](double z1, double z2) {
                                if (!begun) begin(tooth);
                                begun = true;
                                add_interval(tooth, z1, z2);
                              });
  }
  return sum;
}

}  // namespace millstudy::force
