// SPDX-License-Identifier: MIT
#include "force/chip_regimes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "force/chip_phase.h"

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
        sin_tip_(std::sin(tip_angle)),
        cos_tip_(std::cos(tip_angle)),
        tangent_(edges.flutes()[flute].helix_tangent),
        out_(out),
        at_point_(law.reaches()),
        low_(law.reaches()),
        middle_(law.reaches()),
        high_(law.reaches()) {}

  /// A point of the edge with the smallest of the reaches there.
  struct Point {
    double z;
    int smallest;
    double value;  ///< of that [mm]
  };
  Point at(double z) {
    look_at(z);
    int best = 0;
    for (int m = 1; m < law_.reaches(); ++m) {
      if (value(m) < value(best)) best = m;
    }
    return {z, best, value(best)};
  }

  /// Of reaches that cross at most once between the points.
  void split(const Point& low, const Point& high, int depth = 0) {
    const int m1 = low.smallest, m2 = high.smallest;
    if (m1 == m2) return keep_positive(low, high, m1);
    if (depth > 2 * law_.reaches() + 4) return keep_positive(low, at(high.z, m1), m1);
    const auto difference = [&](double z) {
      look_at(z);
      return value(m1) - value(m2);
    };
    const double d1 = difference(low.z), d2 = difference(high.z);
    if (!(d1 < 0.0 && d2 > 0.0)) {  // equal there
      return d1 < 0.0 ? keep_positive(low, at(high.z, m1), m1)
                      : keep_positive(at(low.z, m2), high, m2);
    }
    const Point between = at(root(low.z, d1, high.z, d2, difference));
    if (between.value < value(m1) - kEqual && between.smallest != m1 && between.smallest != m2) {
      split(low, between, depth + 1);
      split(between, high, depth + 1);
    } else {
      keep_positive(low, at(between.z, m1), m1);
      keep_positive(at(between.z, m2), high, m2);
    }
  }

  /// Of reaches that may cross more than once: in parts, and looks between the ends of each before
  /// it takes their word.
  void split_in_parts(double z1, double z2) {
    constexpr int kParts = 16;
    Point low = at(z1, low_);
    for (int i = 1; i <= kParts; ++i) {
      const Point high = at(between(z1, z2, static_cast<double>(i) / kParts), high_);
      split_warily(low, high, 0);
      low = high;
      std::swap(low_, high_);
    }
  }

 private:
  /// With the values of all reaches.
  Point at(double z, std::vector<double>& values) {
    const Point point = at(z);
    for (int m = 0; m < law_.reaches(); ++m) values[m] = value(m);
    return point;
  }

  /// Looks at the middle, and then where parabolas through the three points have their minima. The
  /// values of both ends are in low_ and high_, and when it returns those of the upper one still.
  void split_warily(const Point& low, const Point& high, int depth) {
    constexpr int kDeepest = 3;
    if (depth == kDeepest) return split(low, high);
    const auto hides = [&](const Point& point) {
      return (point.smallest != low.smallest && point.smallest != high.smallest) ||
             ((low.value > 0.0) == (high.value > 0.0) && (low.value > 0.0) != (point.value > 0.0));
    };
    const auto split_at = [&](const Point& point) {
      at(low.z, low_);
      at(point.z, high_);
      split_warily(low, point, depth + 1);
      at(point.z, low_);
      at(high.z, high_);
      split_warily(point, high, depth + 1);
      at(high.z, high_);
    };
    const Point middle = at(between(low.z, high.z, 0.5), middle_);
    if (hides(middle)) return split_at(middle);
    for (int m = -1; m < law_.reaches(); ++m) {
      for (const int smallest : {low.smallest, high.smallest}) {
        if (m == smallest) continue;
        const double part = place_of_dip(m, smallest);
        if (part == 0.0) continue;
        const Point extreme = at(between(low.z, high.z, 0.5 + 0.5 * part));
        if (hides(extreme)) return split_at(extreme);
      }
    }
    // Of the reach of one end and the sign of the other, which is of another reach: one crossing
    // and one zero may be all, or it may be that of the one end once more.
    const auto is_like = [&](const Point& end) {
      return middle.smallest == end.smallest && (middle.value > 0.0) == (end.value > 0.0);
    };
    if (is_like(low) || is_like(high)) return split(low, high);
    split(low, middle);
    split(middle, high);
  }

  /// The height at a part of the way, 0 .. 1: of a climbing feed in the variable of (C11), for
  /// kappa has a root at the tip of an arc; else reaches are smooth in the lag, and so in height.
  double between(double z1, double z2, double part) const {
    if (part == 1.0) return z2;
    if (feed_.slope == 0.0) return z1 + (z2 - z1) * part;
    const double p1 = CuttingEdges::variable(piece_, z1), p2 = CuttingEdges::variable(piece_, z2);
    return std::clamp(edges_.node(piece_, 0.0, p1 + (p2 - p1) * part, 1.0).z, z1, z2);
  }

  /// Where between the points, from -1 to 1, a reach may be less than the smallest, or that may be
  /// zero if m is -1: at the minimum of a parabola, unless that is clearly more. 0 if nowhere.
  double place_of_dip(int m, int smallest) const {
    constexpr double kClearly = 1e-3;  // of the largest: more than what a parabola misses
    const double l = m < 0 ? low_[smallest] : low_[m] - low_[smallest];
    const double c = m < 0 ? middle_[smallest] : middle_[m] - middle_[smallest];
    const double h = m < 0 ? high_[smallest] : high_[m] - high_[smallest];
    const double slope = 0.5 * (h - l), bend = 0.5 * (h + l) - c;
    // Only of zero it may be the maximum.
    if (bend == 0.0 || (m >= 0 && bend < 0.0) || std::abs(slope) >= 2.0 * std::abs(bend))
      return 0.0;
    const double extreme = c - 0.25 * slope * slope / bend;
    const double largest = std::max(
        {std::abs(low_[smallest]), std::abs(high_[smallest]), feed_.per_tooth * law_.reaches()});
    return std::abs(extreme) < kClearly * largest || (extreme < 0.0) != (c < 0.0)
               ? -0.5 * slope / bend
               : 0.0;
  }

  /// Makes value() that of a height.
  void look_at(double z) {
    const EdgePoint point = edge_point(edges_.envelope(), tangent_, z);
    law_.find(flute_, point, at_point_);
    sin_phi_ = sin_tip_ * point.direction[0] - cos_tip_ * point.direction[1];
    // In the plane all reaches have the factor sin(kappa), which is left out: it is zero at a tip.
    if (feed_.slope == 0.0) return;
    const double kappa = piece_.segment.kappa_at(z);
    sin_kappa_ = std::sin(kappa);
    cos_kappa_ = std::cos(kappa);
  }

  double value(int m) const {
    return ChipLaw::reach_over(at_point_[m], feed_, sin_phi_, sin_kappa_, cos_kappa_);
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

  /// A point with another than the smallest.
  Point at(double z, int m) {
    look_at(z);
    return {z, m, value(m)};
  }

  /// The part of a stretch in which reach m, that of both ends, is positive. Goes on with the
  /// stretch before where that is of the same reach; not where coefficients fall with the chip, for
  /// a chip that is nearly zero within a long stretch costs digits there.
  void keep_positive(const Point& low, const Point& high, int m) {
    if (low.value <= 0.0 && high.value <= 0.0) return;
    const auto zero = [&] {
      return root(low.z, low.value, high.z, high.value, [&](double z) { return at(z, m).value; });
    };
    const double bottom = low.value < 0.0 ? zero() : low.z;
    const double top = low.value >= 0.0 && high.value < 0.0 ? zero() : high.z;
    if (!(bottom < top)) return;
    const bool joins = !edges_.variation().with_chip() && !out_.empty() && reach_ == m;
    if (joins && out_.back().top == bottom) {
      out_.back().top = top;
    } else {
      out_.push_back({bottom, top});
    }
    reach_ = m;
  }

  static constexpr double kEqual = 1e-15;  // [mm]

  const CuttingEdges& edges_;
  const ChipLaw& law_;
  const Feed& feed_;
  int flute_;
  const EdgePiece& piece_;
  double sin_tip_;
  double cos_tip_;
  double tangent_;
  std::vector<Regime>& out_;
  int reach_ = 0;  ///< of the last stretch
  std::vector<Reach> at_point_;
  std::vector<double> low_;  ///< values of all reaches
  std::vector<double> middle_;
  std::vector<double> high_;
  double sin_phi_ = 0.0;
  double sin_kappa_ = 1.0;
  double cos_kappa_ = 0.0;
};

/// Heights between which the difference of any two reaches, or of one and none, is zero once,
/// (F29), where all flutes have one helix angle and are fed in the plane.
std::vector<double> heights_between_zeros(const CuttingEdges& edges, const ChipLaw& law,
                                          const Feed& feed, int flute, double tip_angle, double z1,
                                          double z2) {
  constexpr double kQuarter = 1.5;  // of a turn, or less [rad]
  const cutter::Envelope& envelope = edges.envelope();
  const double tangent = edges.flutes()[flute].helix_tangent;
  std::vector<double> heights;
  const auto add = [&](double z) {
    if (z > z1 && z < z2) heights.push_back(z);
  };
  const double lag = envelope.lag(z1), range = envelope.lag(z2) - lag;
  const int parts = 1 + static_cast<int>(std::abs(tangent) * range / kQuarter);
  for (int i = 1; i < parts; ++i) add(envelope.height_at_lag(lag + range * i / parts));
  if (tangent == 0.0) return heights;  // linear in z
  // Not at z2, where another segment may begin.
  const double middle = 0.5 * (z1 + z2);
  const double rise = 1.0 / (tangent * envelope.lag_slope(z1));
  const double rise_slope = (1.0 / (tangent * envelope.lag_slope(middle)) - rise) / (middle - z1);
  using Pair = std::array<double, 2>;  // of cos(psi) and sin(psi)
  const Pair advance = {feed.per_tooth * std::sin(tip_angle),
                        -feed.per_tooth * std::cos(tip_angle)};
  std::vector<std::array<Pair, 2>> lines = {{}};  // at z1, and over height; of none
  for (const ChipLaw::ReachAlong& reach : law.along(flute)) {
    Pair at_z1;
    for (int i = 0; i < 2; ++i) {
      at_z1[i] = reach.ratio * advance[i] + reach.at_tip[i] + z1 * reach.per_height[i];
    }
    lines.push_back({at_z1, reach.per_height});
  }
  const auto difference = [](const Pair& a, const Pair& b) -> Pair {
    return {a[0] - b[0], a[1] - b[1]};
  };
  for (std::size_t m = 0; m < lines.size(); ++m) {
    for (std::size_t n = 0; n < m; ++n) {
      for (const double u :
           heights_of_turning(difference(lines[m][0], lines[n][0]),
                              difference(lines[m][1], lines[n][1]), rise, rise_slope)) {
        add(z1 + u);
      }
    }
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

}  // namespace

void find_regimes(const CuttingEdges& edges, const ChipLaw& law, const Feed& feed, int flute,
                  const EdgePiece& piece, double tip_angle, double z1, double z2,
                  std::vector<Regime>& out) {
  out.clear();
  constexpr int kMostPaired = 8;  // of more teeth, to look for all pairs takes longer than in parts
  const bool in_phase = !edges.variable_helix() && feed.slope == 0.0;
  const bool crosses_once = in_phase && edges.cutter().runout.tilt == 0.0;
  if (crosses_once && law.reaches() == 1) {
    out.push_back({z1, z2});
    return;
  }
  RegimeFinder finder(edges, law, feed, flute, piece, tip_angle, out);
  if (crosses_once) return finder.split(finder.at(z1), finder.at(z2));
  if (!in_phase || law.reaches() > kMostPaired) return finder.split_in_parts(z1, z2);
  RegimeFinder::Point low = finder.at(z1);
  for (const double z : heights_between_zeros(edges, law, feed, flute, tip_angle, z1, z2)) {
    const RegimeFinder::Point high = finder.at(z);
    finder.split(low, high);
    low = high;
  }
  finder.split(low, finder.at(z2));
}

}  // namespace millstudy::force
