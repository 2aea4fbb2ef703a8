// SPDX-License-Identifier: MIT
#include "dynamics/regenerative_cut.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace millstudy::dynamics {
namespace {

/// Below this lag the closed form of a cylinder loses more digits than nodes do [rad].
constexpr double kShortLag = 0.05;

}  // namespace

RegenerativeCut::RegenerativeCut(const cutter::Cutter& cutter, const force::Engagement& engagement,
                                 const force::Coefficients& coefficients,
                                 const force::Variation& variation)
    : swept_(engagement.arc()), coefficients_(coefficients) {
  cutter::check(cutter);
  force::check(cutter, engagement);
  force::check(variation);
  if (cutter::has_runout(cutter)) {
    throw core::InputError("stability of a cutter with runout is found in the time domain only");
  }
  if (variation.with_chip()) {
    throw core::InputError(
        "stability with coefficients that depend on the chip is found in the time domain only");
  }
  edges_ = std::make_shared<const force::CuttingEdges>(cutter, engagement.axial_depth, variation);
}

RegenerativeCut RegenerativeCut::process_damping(double coefficient) const {
  // A radial force per radial velocity: what a radial coefficient alone does with positions.
  RegenerativeCut damping = *this;
  damping.coefficients_ = {};
  damping.coefficients_.Krc = coefficient;
  if (edges_->variation().with_height()) {
    damping.edges_ = std::make_shared<const force::CuttingEdges>(
        edges_->cutter(), edges_->axial_depth(), force::Variation{});
  }
  return damping;
}

double RegenerativeCut::period_angle() const {
  return edges_->equal_flutes() ? core::kTurn / edges_->cutter().flutes : core::kTurn;
}

double RegenerativeCut::pitch(int flute, double lag) const {
  return edges_->pitch_ratio(flute, lag) * core::kTurn / edges_->cutter().flutes;
}

RegenerativeCut::Weights RegenerativeCut::weights(int flute, const force::EdgeNode& node) const {
  const std::array<double, 6> factors = edges_->factors(flute, node);
  const double dz = node.width * node.sin_kappa;
  return {coefficients_.Ktc * factors[0] * dz, (coefficients_.Krc * factors[1] * node.sin_kappa +
                                                coefficients_.Kac * factors[2] * node.cos_kappa) *
                                                   dz};
}

bool RegenerativeCut::has_closed_form(int flute, const force::EdgePiece& piece, double z1,
                                      double z2) const {
  if (!piece.segment.is_cylinder() || edges_->variation().with_height()) return false;
  const double tangent = edges_->flutes()[flute].helix_tangent;
  const double lag = tangent * (edges_->envelope().lag(z2) - edges_->envelope().lag(z1));
  return lag == 0.0 || std::abs(lag) > kShortLag;
}

Eigen::Matrix2d RegenerativeCut::stiffness(int flute, double tip_angle) const {
  const double tangent = edges_->flutes()[flute].helix_tangent;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  const auto add = [&](double z1, double z2) {
    for (const force::EdgePiece& piece : edges_->pieces()) {
      const double from = std::max(z1, piece.bottom), to = std::min(z2, piece.top);
      if (from >= to) continue;
      if (!piece.segment.is_cylinder() || edges_->variation().with_height()) {
        for_each_node_of(flute, piece, tip_angle, from, to,
                         [&](double, const Eigen::Matrix2d& a) { sum += a; });
        continue;
      }
      // (F8): closed form at any lag.
      const force::EdgeNode middle = edges_->node(piece, tangent, 0.5 * (from + to), to - from);
      const double turn = tangent * edges_->envelope().lag_slope(from) * (to - from);
      const double twice = 2.0 * (tip_angle - tangent * middle.lag), share = force::sinc(turn);
      const auto [t, r] = weights(flute, middle);
      sum += directional(t, r, {1.0, share * std::cos(twice), share * std::sin(twice)});
    }
  };
  force::for_each_engaged_interval(*edges_, tangent, swept_.arc(), tip_angle, add);
  return sum;
}

Eigen::Matrix2d RegenerativeCut::swept_nodes(int flute, const force::EdgePiece& piece,
                                             double tip_angle, double z1, double z2) const {
  const double tangent = edges_->flutes()[flute].helix_tangent;
  const cutter::Envelope& envelope = edges_->envelope();
  // The integrand has corners where a point of the edge stands at the entry or the exit.
  std::vector<double> ends = {z1};
  const double lag1 = envelope.lag(z1), lag2 = envelope.lag(z2);
  for (const double limit : {swept_.entry(), swept_.entry() + swept_.width()}) {
    const double first = (tip_angle - limit) / core::kTurn;
    const double a = first - tangent * lag1 / core::kTurn;
    const double b = first - tangent * lag2 / core::kTurn;
    for (double turn = std::ceil(std::min(a, b)); turn <= std::max(a, b); turn += 1.0) {
      const double lag = core::kTurn * (first - turn) / tangent;
      if (lag > lag1 && lag < lag2) ends.push_back(std::clamp(envelope.height_at_lag(lag), z1, z2));
    }
  }
  ends.push_back(z2);
  std::sort(ends.begin(), ends.end());
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (!(ends[i] < ends[i + 1])) continue;
    edges_->for_each_node(piece, tangent, ends[i], ends[i + 1], [&](const force::EdgeNode& node) {
      const auto [t, r] = weights(flute, node);
      sum += directional(t, r, swept_.once(tip_angle - tangent * node.lag));
    });
  }
  return sum;
}

Eigen::Matrix2d RegenerativeCut::swept(int flute, double tip_angle, double z1, double z2) const {
  const double tangent = edges_->flutes()[flute].helix_tangent;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const force::EdgePiece& piece : edges_->pieces()) {
    const double from = std::max(z1, piece.bottom), to = std::min(z2, piece.top);
    if (from >= to) continue;
    if (!has_closed_form(flute, piece, from, to)) {
      sum += swept_nodes(flute, piece, tip_angle, from, to);
      continue;
    }
    const cutter::Envelope& envelope = edges_->envelope();
    const double low = tangent * envelope.lag(from), high = tangent * envelope.lag(to);
    const auto [t, r] = weights(flute, edges_->node(piece, tangent, 0.5 * (from + to), to - from));
    const Eigen::Vector3d terms =
        low == high
            ? swept_.once(tip_angle - low)
            : Eigen::Vector3d((swept_.twice(tip_angle - low) - swept_.twice(tip_angle - high)) /
                              (high - low));
    sum += directional(t, r, terms);
  }
  return sum;
}

std::vector<Eigen::Matrix2d> RegenerativeCut::swept(int flute, double first_angle, double step,
                                                    int count, double z1, double z2) const {
  std::vector<Eigen::Matrix2d> all(count, Eigen::Matrix2d::Zero());
  const double tangent = edges_->flutes()[flute].helix_tangent;
  for (const force::EdgePiece& piece : edges_->pieces()) {
    const double from = std::max(z1, piece.bottom), to = std::min(z2, piece.top);
    if (from >= to) continue;
    const cutter::Envelope& envelope = edges_->envelope();
    const double low = tangent * envelope.lag(from), high = tangent * envelope.lag(to);
    if (low != high || !has_closed_form(flute, piece, from, to)) {
      for (int i = 0; i < count; ++i) {
        all[i] += swept(flute, first_angle + i * step, from, to);
      }
      continue;
    }
    const auto [t, r] = weights(flute, edges_->node(piece, tangent, 0.5 * (from + to), to - from));
    swept_.for_each_once(first_angle - low, step, count,
                         [&, t = t, r = r](int i, const Eigen::Vector3d& terms) {
                           all[i] += directional(t, r, terms);
                         });
  }
  return all;
}

Eigen::Matrix2d RegenerativeCut::mean_stiffness() const {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  const double depth = edges_->axial_depth();
  for (int j = 0; j < edges_->cutter().flutes; ++j) {
    sum += swept(j, core::kTurn, 0.0, depth) - swept(j, 0.0, 0.0, depth);
  }
  return sum / core::kTurn;
}

}  // namespace millstudy::dynamics
