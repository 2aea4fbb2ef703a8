// SPDX-License-Identifier: MIT
#include "path/figures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "path/chord_step.h"

namespace millstudy::path {
namespace {

constexpr int kSamples = 8;   // of a span within a step, before refining
constexpr int kRefines = 20;  // golden section: 0.618^20 = 7e-5 of the interval

/// The chord of one step in the frame of a span, and the distance of a point of it (P20).
struct Chord {
  Vec3 from;
  Vec3 along;
  double inverse_square;  // 0 where the chord has no length

  Chord(const Curve& curve, const Stand& a, const Stand& b, std::size_t span) {
    from = (a.point.position + curve.offset(a.at.span, span)).xyz();
    along = (b.point.position + curve.offset(b.at.span, span)).xyz() - from;
    const double square = dot(along, along);
    inverse_square = square > 0.0 ? 1.0 / square : 0.0;
  }

  double distance(const Vec3& point) const {
    const Vec3 arm = point - from;
    const double share = std::clamp(dot(arm, along) * inverse_square, 0.0, 1.0);
    return norm(arm - share * along);
  }
};

double golden_section_max(const auto& f, double low, double high) {
  constexpr double kRatio = 0.6180339887498949;
  double a = high - kRatio * (high - low);
  double b = low + kRatio * (high - low);
  double fa = f(a);
  double fb = f(b);
  for (int i = 0; i < kRefines; ++i) {
    if (fa > fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - kRatio * (high - low);
      fa = f(a);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + kRatio * (high - low);
      fb = f(b);
    }
  }
  return std::max(fa, fb);
}

/// Largest distance from the chord over the whole step.
double step_error(const Curve& curve, const Stand& a, const Stand& b) {
  double worst = 0.0;
  for (std::size_t k = a.at.span; k <= b.at.span; ++k) {
    const Chord chord(curve, a, b, k);
    const auto distance = [&](double t) {
      return chord.distance(curve.local({k, t}).position.xyz());
    };
    const double low = k == a.at.span ? a.at.t : -1.0;
    const double width = ((k == b.at.span ? b.at.t : 1.0) - low) / kSamples;
    int best = 0;
    double most = -1.0;
    for (int i = 0; i <= kSamples; ++i) {
      const double d = distance(low + i * width);
      if (d > most) {
        most = d;
        best = i;
      }
    }
    const double refined = golden_section_max(distance, low + std::max(best - 1, 0) * width,
                                              low + std::min(best + 1, kSamples) * width);
    worst = std::max({worst, most, refined});
  }
  return worst;
}

double middle_error(const Curve& curve, const Stand& a, const Stand& b) {
  const Chord chord(curve, a, b, a.at.span);
  return chord.distance(curve.local({a.at.span, 0.5 * (a.at.t + b.at.t)}).position.xyz());
}

/// Branch and bound: a parabola's arrow |R''| dt^2 / 8 bounds the error of a step within a span, so
/// only the few steps that may beat the best one found are looked at closely.
double largest_error(const Curve& curve, const std::vector<Stand>& stands) {
  double worst = 0.0;
  for (std::size_t i = 1; i < stands.size(); ++i) {
    if (stands[i - 1].at.span != stands[i].at.span) continue;
    worst = std::max(worst, middle_error(curve, stands[i - 1], stands[i]));
  }
  for (std::size_t i = 1; i < stands.size(); ++i) {
    const Stand& a = stands[i - 1];
    const Stand& b = stands[i];
    if (a.at.span == b.at.span) {
      const double dt = b.at.t - a.at.t;
      if (curve.spans()[a.at.span].bend * dt * dt / 8.0 <= worst) continue;
    }
    worst = std::max(worst, step_error(curve, a, b));
  }
  return worst;
}

}  // namespace

PathFigures path_figures(const Curve& curve, const Interpolation& path) {
  PathFigures figures;
  std::vector<Stand> stands;
  stands.reserve(path.parameters.size());
  std::size_t span = 0;
  for (const double u : path.parameters) {
    const Cursor at = curve.locate(u, span);
    span = at.span;
    stands.push_back(stand_at(curve, at));
  }
  double sum = 0.0;
  for (std::int64_t i = 0; i < path.full_steps; ++i) {
    const double delta = 1.0 - chord_length(curve, stands[i], stands[i + 1]) / path.wanted_chord;
    figures.feed_fluctuation_max = std::max(figures.feed_fluctuation_max, std::abs(delta));
    sum += delta * delta;
  }
  figures.feed_fluctuation_max *= 100.0;
  figures.feed_fluctuation_l2 = 100.0 * std::sqrt(sum);
  if (path.full_steps > 0) {
    figures.feed_fluctuation_rms = 100.0 * std::sqrt(sum / static_cast<double>(path.full_steps));
  }
  figures.steps = static_cast<double>(path.full_steps);
  figures.curve_evaluations = static_cast<double>(path.curve_evaluations);
  figures.fallback_steps = static_cast<double>(path.fallback_steps);
  figures.path_length = curve.length();
  figures.path_time = static_cast<double>(path.full_steps + (path.partial ? 1 : 0)) * path.period;
  figures.chord_error_max = largest_error(curve, stands);
  return figures;
}

}  // namespace millstudy::path
