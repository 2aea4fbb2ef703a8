// SPDX-License-Identifier: MIT
#include "unit/force/reference_integral.h"

#include <algorithm>
#include <cmath>

namespace millstudy::force::reference {
namespace {

constexpr double kTurn = 2.0 * M_PI;

/// Gathers both ends: a root of the integrand there, of the tip of a ball or of a chip that ends,
/// becomes smooth.
double gathered(double s) {
  return s * s * s * (10.0 - s * (15.0 - 6.0 * s));
}

/// One flute at one angle.
class Edge {
 public:
  Edge(const Tool& tool, const Cut& cut, int flute, double tip_angle, double tolerance)
      : tool_(tool), cut_(cut), flute_(flute), tip_(tip_angle), tolerance_(tolerance) {
    double radius = 0.0;
    for (const Stretch& s : tool.stretches()) {
      if (s.bottom < cut.axial_depth) radius = std::max(radius, tool.place(s.bottom).r);
    }
    lever_ = cut.axial_depth + std::max(radius, tool.place(cut.axial_depth).r);
  }

  Load integral() {
    const std::vector<double> at = corners();
    for (std::size_t i = 1; i < at.size(); ++i) {
      if (at[i] - at[i - 1] > 4e-16 * at[i] && in_cut(0.5 * (at[i - 1] + at[i]))) {
        add_between_switches(at[i - 1], at[i]);
      }
    }
    return sum_;
  }

 private:
  double phi(double z) const { return tip_ - tool_.tangent(flute_) * tool_.lambda(z); }
  Chip chip_at(double z) const { return chip(tool_, cut_.feed, flute_, tip_, z); }

  bool in_cut(double z) const {
    return std::any_of(cut_.arcs.begin(), cut_.arcs.end(), [&](const Arc& arc) {
      const double turns = (phi(z) - arc.entry_angle) / kTurn;
      return kTurn * (turns - std::floor(turns)) < arc.exit_angle - arc.entry_angle;
    });
  }

  /// Where envelope, tables and engagement have corners, ascending.
  std::vector<double> corners() const {
    const double depth = cut_.axial_depth;
    std::vector<double> all = {0.0, depth};
    const auto add = [&](double z) {
      if (z > 0.0 && z < depth) all.push_back(z);
    };
    for (const Stretch& s : tool_.stretches()) add(s.bottom);
    if (cut_.variation.height) {
      for (const double z : cut_.variation.height->heights) add(z);
    }
    const double first = phi(0.0), last = phi(depth);
    for (const Arc& arc : cut_.arcs) {
      for (const double limit : {arc.entry_angle, arc.exit_angle}) {
        const double low = std::min(first, last), high = std::max(first, last);
        for (double k = std::ceil((low - limit) / kTurn); limit + k * kTurn <= high; ++k) {
          add(bisect(0.0, depth, [&](double z) {
            return (phi(z) < limit + k * kTurn) == (first < limit + k * kTurn);
          }));
        }
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  /// Where a condition that holds at a ends, on the way to b.
  template <class Condition>
  static double bisect(double a, double b, const Condition& holds) {
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (a + b);
      if (middle == a || middle == b) break;
      (holds(middle) ? a : b) = middle;
    }
    return b;
  }

  void add_between_switches(double z1, double z2) {
    constexpr int kScan = 96;
    if (!tool_.runs_out() && cut_.feed.slope == 0.0) return add(z1, z2);
    std::vector<double> z;
    std::vector<Chip> c;
    for (int i = 0; i <= kScan; ++i) {
      z.push_back(i == kScan ? z2 : z1 + (z2 - z1) * gathered(static_cast<double>(i) / kScan));
      c.push_back(chip_at(z.back()));
    }
    std::vector<double> at = {z1, z2};
    for (int i = 0; i < kScan; ++i) find_switches(z[i], z[i + 1], at);
    for (int i = 1; i < kScan; ++i) {
      const double h = std::abs(c[i].thickness), before = std::abs(c[i - 1].thickness),
                   after = std::abs(c[i + 1].thickness);
      if (h > before || h > after || h > before + after - 2.0 * h) continue;
      const double turning = nearest_to_zero(z[i - 1], z[i + 1], c[i].thickness > 0.0 ? 1.0 : -1.0);
      if ((chip_at(turning).thickness > 0.0) == (c[i].thickness > 0.0)) continue;
      find_switches(z[i - 1], turning, at);
      find_switches(turning, z[i + 1], at);
    }
    std::sort(at.begin(), at.end());
    for (std::size_t i = 1; i < at.size(); ++i) {
      if (at[i] > at[i - 1] && chip_at(0.5 * (at[i - 1] + at[i])).thickness > 0.0) {
        add(at[i - 1], at[i]);
      }
    }
  }

  /// Between neighbours of the scan: where the deciding flute or the sign of the chip changes.
  void find_switches(double a, double b, std::vector<double>& at) const {
    const Chip last = chip_at(b);
    for (int tries = 0; tries < 8; ++tries) {
      const Chip first = chip_at(a);
      const bool positive = first.thickness > 0.0;
      const int by = first.decided_by;
      if (by == last.decided_by && positive == (last.thickness > 0.0)) return;
      a = bisect(a, b, [&](double z) {
        const Chip c = chip_at(z);
        return c.decided_by == by && (c.thickness > 0.0) == positive;
      });
      at.push_back(a);
    }
  }

  /// Golden section for the least of sign times thickness.
  double nearest_to_zero(double a, double b, double sign) const {
    const double part = 0.5 * (3.0 - std::sqrt(5.0));
    double c = a + part * (b - a), d = b - part * (b - a);
    double hc = sign * chip_at(c).thickness, hd = sign * chip_at(d).thickness;
    for (int i = 0; i < 60 && hc > 0.0 && hd > 0.0; ++i) {
      if (hc < hd) {
        b = d, d = c, hd = hc;
        c = a + part * (b - a), hc = sign * chip_at(c).thickness;
      } else {
        a = c, c = d, hc = hd;
        d = b - part * (b - a), hd = sign * chip_at(d).thickness;
      }
    }
    return hc < hd ? c : d;
  }

  Load density(double z) const {
    const double h = chip_at(z).thickness;
    if (!(h > 0.0)) return {};
    const Place p = tool_.place(z);
    const double bend = std::abs(p.r * tool_.tangent(flute_) * tool_.lambda_slope(z) * p.sin_kappa);
    const double db = 1.0 / p.sin_kappa;
    const double ds = db * (tool_.per_width() ? 1.0 : std::sqrt(1.0 + bend * bend));
    const std::array<double, 6> k = coefficients_at(cut_, z, h, bend);
    const double ft = k[0] * h * db + k[3] * ds;
    const double fr = k[1] * h * db + k[4] * ds;
    const double fa = k[2] * h * db + k[5] * ds;
    const double s = std::sin(phi(z)), c = std::cos(phi(z));
    const double x = -fr * s * p.sin_kappa - ft * c - fa * s * p.cos_kappa;
    const double y = -fr * c * p.sin_kappa + ft * s - fa * c * p.cos_kappa;
    const double up = fr * p.cos_kappa - fa * p.sin_kappa;
    return {x, y, up, p.r * ft, p.r * c * up - z * y, z * x - p.r * s * up};
  }

  void add(double z1, double z2) { add(z1, z2, 0.0, 1.0, 0); }

  /// Gauss-Kronrod 7-15 (QUADPACK) over s, z = z1 .. z2 gathered, halved until the two agree.
  void add(double z1, double z2, double from, double to, int depth) {
    static constexpr std::array<double, 8> kNodes = {
        0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
        0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
        0.586087235467691130294144691693460, 0.405845151377397166906606412076961,
        0.207784955007898467600689403773245, 0.0};
    static constexpr std::array<double, 8> kKronrod = {
        0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
        0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
        0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
        0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
    static constexpr std::array<double, 4> kGauss = {
        0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
        0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    Load fine{}, difference{};
    for (int i = 0; i < 15; ++i) {
      const int n = i < 8 ? i : 14 - i;
      const double s = middle + (i < 8 ? -half : half) * kNodes[n];
      const double dz = 30.0 * s * s * (1.0 - s) * (1.0 - s) * (z2 - z1) * half;
      const Load f = density(z1 + (z2 - z1) * gathered(s));
      for (int row = 0; row < 6; ++row) {
        fine[row] += kKronrod[n] * dz * f[row];
        difference[row] += (kKronrod[n] - (n % 2 == 1 ? kGauss[n / 2] : 0.0)) * dz * f[row];
      }
    }
    double error = 0.0;
    for (int row = 0; row < 6; ++row) {
      error = std::max(error, std::abs(difference[row]) / (row < 3 ? 1.0 : lever_));
    }
    if (error < tolerance_ || depth > 40) {
      for (int row = 0; row < 6; ++row) sum_[row] += fine[row];
      return;
    }
    add(z1, z2, from, middle, depth + 1);
    add(z1, z2, middle, to, depth + 1);
  }

  const Tool& tool_;
  const Cut& cut_;
  int flute_;
  double tip_;
  double tolerance_;
  double lever_;
  Load sum_{};
};

}  // namespace

Load flute_load(const Tool& tool, const Cut& cut, int flute, double tip_angle, double tolerance) {
  return Edge(tool, cut, flute, tip_angle, tolerance).integral();
}

Load load(const Tool& tool, const Cut& cut, double phi, double tolerance) {
  Load sum{};
  for (int j = 0; j < tool.flutes(); ++j) {
    const Load one = flute_load(tool, cut, j, phi + tool.position(j), tolerance);
    for (int row = 0; row < 6; ++row) sum[row] += one[row];
  }
  return sum;
}

}  // namespace millstudy::force::reference
