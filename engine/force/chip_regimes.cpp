// SPDX-License-Identifier: MIT
#include "force/chip_regimes.h"

#include <cmath>

namespace millstudy::force {
namespace {

/// Everything about one edge at one spindle angle.
class RegimeFinder {
 public:
  RegimeFinder(const CuttingEdges& edges, const ChipLaw& law, const Feed& feed, int flute,
               const EdgePiece& piece, double tip_angle, std::vector<Regime>& out)
      : edges_(edges),
        law_(law),
        feed_(feed),
        flute_(flute),
        piece_(piece),
        tip_angle_(tip_angle),
        tangent_(edges.flutes()[flute].helix_tangent),
        out_(out),
        at_point_(law.reaches()) {}

  void split(double z1, double z2) { split(z1, smallest_at(z1), z2, smallest_at(z2)); }

  /// Of reaches that may cross more than once: looks between the ends before it takes their word.
  void split_warily(double z1, double z2, int depth = 0) {
    constexpr int kDeepest = 3;
    const double middle = 0.5 * (z1 + z2);
    const int m1 = smallest_at(z1), m2 = smallest_at(z2), between = smallest_at(middle);
    const bool above = value(between) > 0.0;
    look_at(z1);
    const bool above1 = value(m1) > 0.0;
    look_at(z2);
    const bool above2 = value(m2) > 0.0;
    const bool hidden = (m1 == m2 && between != m1) || (above1 == above2 && above != above1);
    if (hidden && depth < kDeepest) {
      split_warily(z1, middle, depth + 1);
      split_warily(middle, z2, depth + 1);
    } else {
      split(z1, m1, z2, m2);
    }
  }

 private:
  /// Values of all reaches at a height go to at_point_ and sines_.
  void look_at(double z) {
    const double lag = edges_.envelope().lag(z);
    law_.find(flute_, z, lag, at_point_);
    sin_phi_ = std::sin(tip_angle_ - tangent_ * lag);
    // In the plane all reaches have the factor sin(kappa), which is left out: it is zero at a tip.
    if (feed_.slope == 0.0) return;
    const double kappa = piece_.segment.kappa_at(z);
    sin_kappa_ = std::sin(kappa);
    cos_kappa_ = std::cos(kappa);
  }

  double value(int m) const {
    return ChipLaw::reach_over(at_point_[m], feed_, sin_phi_, sin_kappa_, cos_kappa_);
  }

  int smallest_at(double z) {
    look_at(z);
    int best = 0;
    for (int m = 1; m < law_.reaches(); ++m) {
      if (value(m) < value(best)) best = m;
    }
    return best;
  }

  /// Root of f between a and b, of different signs at both: Illinois steps, then bisection.
  template <class Function>
  double root(double a, double fa, double b, double fb, const Function& f) {
    int side = 0;
    for (int i = 0; i < 100 && std::abs(b - a) > 4e-16 * (std::abs(a) + std::abs(b)); ++i) {
      double z = i < 40 ? (a * fb - b * fa) / (fb - fa) : 0.5 * (a + b);
      if (!(z > std::min(a, b) && z < std::max(a, b))) z = 0.5 * (a + b);
      if (z == a || z == b) break;
      const double fz = f(z);
      if (fz == 0.0) return z;
      if ((fz > 0.0) == (fb > 0.0)) {
        b = z, fb = fz;
        if (side == 1) fa *= 0.5;
        side = 1;
      } else {
        a = z, fa = fz;
        if (side == -1) fb *= 0.5;
        side = -1;
      }
    }
    return 0.5 * (a + b);
  }

  void split(double z1, int m1, double z2, int m2, int depth = 0) {
    if (m1 == m2 || depth > 2 * law_.reaches() + 4) return keep_positive(z1, z2, m1);
    const auto difference = [&](double z) {
      look_at(z);
      return value(m1) - value(m2);
    };
    const double d1 = difference(z1), d2 = difference(z2);
    if (!(d1 < 0.0 && d2 > 0.0)) return keep_positive(z1, z2, d1 < 0.0 ? m1 : m2);  // equal there
    const double z = root(z1, d1, z2, d2, difference);
    const int between = smallest_at(z);
    if (value(between) < value(m1) - kEqual && between != m1 && between != m2) {
      split(z1, m1, z, between, depth + 1);
      split(z, between, z2, m2, depth + 1);
    } else {
      keep_positive(z1, z, m1);
      keep_positive(z, z2, m2);
    }
  }

  /// The part of a stretch in which reach m is positive.
  void keep_positive(double z1, double z2, int m) {
    const auto thickness = [&](double z) {
      look_at(z);
      return value(m);
    };
    const double h1 = thickness(z1), h2 = thickness(z2);
    if (h1 <= 0.0 && h2 <= 0.0) return;
    if (h1 < 0.0)
      z1 = root(z1, h1, z2, h2, thickness);
    else if (h2 < 0.0)
      z2 = root(z1, h1, z2, h2, thickness);
    if (z1 < z2) out_.push_back({z1, z2});
  }

  static constexpr double kEqual = 1e-15;  // [mm]

  const CuttingEdges& edges_;
  const ChipLaw& law_;
  const Feed& feed_;
  int flute_;
  const EdgePiece& piece_;
  double tip_angle_;
  double tangent_;
  std::vector<Regime>& out_;
  std::vector<Reach> at_point_;
  double sin_phi_ = 0.0;
  double sin_kappa_ = 1.0;
  double cos_kappa_ = 0.0;
};

}  // namespace

void find_regimes(const CuttingEdges& edges, const ChipLaw& law, const Feed& feed, int flute,
                  const EdgePiece& piece, double tip_angle, double z1, double z2,
                  std::vector<Regime>& out) {
  out.clear();
  const bool crosses_once =
      !edges.variable_helix() && edges.cutter().runout.tilt == 0.0 && feed.slope == 0.0;
  if (crosses_once && law.reaches() == 1) {
    out.push_back({z1, z2});
    return;
  }
  RegimeFinder finder(edges, law, feed, flute, piece, tip_angle, out);
  if (crosses_once) return finder.split(z1, z2);
  constexpr int kParts = 16;
  for (int i = 0; i < kParts; ++i) {
    finder.split_warily(z1 + (z2 - z1) * i / kParts,
                        i + 1 == kParts ? z2 : z1 + (z2 - z1) * (i + 1) / kParts);
  }
}

}  // namespace millstudy::force
