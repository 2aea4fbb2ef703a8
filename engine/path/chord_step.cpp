// SPDX-License-Identifier: MIT
#include "path/chord_step.h"

#include <cmath>
#include <limits>

#include "path/chord_root.h"

namespace millstudy::path {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kMostTurn = 0.7;       // < sin 45 degrees: two tangents differ by < 90 degrees
constexpr double kConverged = 1e-11;    // of the chord: below it Newton need not contract
constexpr double kMostResidual = 0.5;   // of the chord
constexpr int kUpdatesToConverge = 10;  // by then a quadratic method is done
constexpr double kContraction = 0.5;    // of a bracketed step: slower than halving is halved
constexpr int kMostBracketSteps = 200;

/// Places of a step in one frame: `from` about the origin of the span the iterate is in.
class ChordFrame {
 public:
  ChordFrame(const Curve& curve, const Stand& from)
      : curve_(curve), from_(from), span_(from.at.span), local_(from.point.position) {}

  Lanes chord_to(Cursor at, const LocalPoint& point) {
    if (at.span != span_) {
      span_ = at.span;
      local_ = from_.point.position + curve_.offset(from_.at.span, span_);
    }
    return point.position - local_;
  }

 private:
  const Curve& curve_;
  const Stand& from_;
  std::size_t span_;
  Lanes local_;
};

bool is_ahead(Cursor a, Cursor b) {
  return b.span > a.span || (b.span == a.span && b.t > a.t);
}

bool at_end(const Curve& curve, Cursor at) {
  return at.span + 1 == curve.spans().size() && at.t >= 1.0;
}

/// (P11): the tangent stays within a cone of 45 degrees about the tangent at the start.
bool chord_surely_grows(const Curve& curve, const Stand& from, Cursor to, double speed) {
  const std::span<const Span> spans = curve.spans();
  const std::size_t first = from.at.span;
  if (to.span == first) return spans[first].bend * (to.t - from.at.t) < kMostTurn * speed;
  double change = spans[first].bend * (1.0 - from.at.t) * spans[first].inverse_half;
  for (std::size_t k = first + 1; k <= to.span; ++k) {
    const double width = (k == to.span ? to.t : 1.0) + 1.0;
    change += spans[k].kink + spans[k].bend * width * spans[k].inverse_half;
  }
  return change < kMostTurn * speed * spans[first].inverse_half;
}

/// The rest of the curve, where Newton wants to go beyond its end or cannot start.
ChordStep search_step(const Curve& curve, const Stand& from, double chord,
                      std::int64_t evaluations) {
  ChordStep step = first_root_step(curve, from, chord);
  step.evaluations += evaluations;
  return step;
}

}  // namespace

double chord_length(const Curve& curve, const Stand& from, const Stand& to) {
  const Lanes chord = ChordFrame(curve, from).chord_to(to.at, to.point);
  return std::sqrt(dot(chord, chord));
}

ChordStep newton_step(const Curve& curve, const Stand& from, const ChordSettings& settings) {
  const double chord = settings.chord;
  const double speed_squared = dot(from.point.first, from.point.first);
  const double speed = std::sqrt(speed_squared);
  const double start = chord * speed / speed_squared;  // (P9)
  if (speed <= curve.spans()[from.at.span].rest || !std::isfinite(start)) {
    return search_step(curve, from, chord, 0);
  }

  ChordStep step;
  ChordFrame frame(curve, from);
  Cursor at{from.at.span, from.at.t + start};
  double residual = 0.0;
  double previous = std::numeric_limits<double>::infinity();
  int updates = 0;
  for (;; ++updates) {
    at = curve.settle(at);
    step.to = {at, curve.local(at)};
    ++step.evaluations;
    const Lanes reach = frame.chord_to(at, step.to.point);
    const double length = std::sqrt(dot(reach, reach));
    residual = chord - length;
    if (updates == settings.max_iterations || std::abs(residual) < settings.tolerance * chord) {
      break;
    }
    const double growth = dot(reach, step.to.point.first);
    const bool beyond = residual > 0.0 && at_end(curve, at);
    if (!(growth > 0.0) || beyond) return search_step(curve, from, chord, step.evaluations);
    previous = std::abs(residual);
    at.t += residual * length / growth;  // (P8)
  }

  const double off = std::abs(residual);
  const bool converged =
      off <= settings.tolerance * chord || off <= kConverged * chord + 4.0 * kEpsilon * speed;
  const bool converging =
      updates < kUpdatesToConverge && off <= previous && off <= kMostResidual * chord;
  if ((converged || converging) && is_ahead(from.at, at) &&
      !(at_end(curve, at) && residual > kConverged * chord)) {
    if (chord_surely_grows(curve, from, at, speed)) return step;
    if (chord_sign_changes(curve, from.at, from.point.position, at, chord) <= 1) return step;
  }
  return search_step(curve, from, chord, step.evaluations);
}

ChordStep first_root_step(const Curve& curve, const Stand& from, double chord) {
  ChordStep step;
  const RootBracket root = first_chord_root(curve, from.at, from.point.position, chord);
  if (!root.found) {
    const Cursor end{curve.spans().size() - 1, 1.0};
    step.to = {end, curve.local(end)};
    step.ended = true;
    step.evaluations = 1;
    return step;
  }
  step.fallback = true;
  step.evaluations = root.pieces;
  ChordFrame frame(curve, from);
  double low = root.low;
  double high = root.high;
  double best = std::numeric_limits<double>::infinity();
  double previous = best;
  double t = 0.5 * (low + high);
  for (int i = 0; i < kMostBracketSteps; ++i) {
    const Cursor at{root.span, t};
    const Stand here{at, curve.local(at)};
    ++step.evaluations;
    const Lanes reach = frame.chord_to(at, here.point);
    const double length = std::sqrt(dot(reach, reach));
    const double residual = chord - length;
    if (std::abs(residual) < best) {
      best = std::abs(residual);
      step.to = here;
    }
    (residual > 0.0 ? low : high) = t;
    if (best <= 2.0 * kEpsilon * chord || !(high > low)) break;
    double next = t + residual * length / dot(reach, here.point.first);
    const bool slow = std::abs(residual) > kContraction * previous;
    if (slow || !(next > low && next < high)) next = 0.5 * (low + high);
    if (next == t || next <= low || next >= high) break;
    previous = std::abs(residual);
    t = next;
  }
  return step;
}

}  // namespace millstudy::path
