// SPDX-License-Identifier: MIT
#include "path/chord_step.h"

#include <cmath>
#include <limits>

#include "path/chord_root.h"
#include "path/local_chord.h"

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

  Homogeneous chord_to(Cursor at, const LocalPoint& point) {
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
  Homogeneous local_;
};

bool is_ahead(Cursor a, Cursor b) {
  return b.span > a.span || (b.span == a.span && b.t > a.t);
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

/// What is known of a step when its updates are done.
struct NewtonEnd {
  Cursor at;
  double residual;  // wanted chord less chord
  double previous;  // |residual| one update before
  double speed;     // |dR/dt| at the start
  int updates;
};

/// Whether Newton's result stands: it converged or is converging, went forward, and lies on the
/// first rise of the chord.
bool stands(const Curve& curve, const Stand& from, const NewtonEnd& end,
            const ChordSettings& settings) {
  const double chord = settings.chord;
  const double off = std::abs(end.residual);
  const bool converged =
      off < settings.tolerance * chord || off <= kConverged * chord + 4.0 * kEpsilon * end.speed;
  const bool converging =
      end.updates < kUpdatesToConverge && off <= end.previous && off <= kMostResidual * chord;
  if (!(converged || converging) || !is_ahead(from.at, end.at)) return false;
  if (curve.at_end(end.at) && end.residual > kConverged * chord) return false;
  return chord_surely_grows(curve, from, end.at, end.speed) ||
         chord_sign_changes(curve, from.at, from.point.position, end.at, chord) <= 1;
}

/// (P8) to (P10) for a step that begins and ends in one span. Not taken if an iterate leaves it.
template <int kDegree, bool kRational>
bool take_local_step(const Curve& curve, const Stand& from, const ChordSettings& settings,
                     ChordStep& step) {
  const LocalChord<kDegree, kRational> local(curve.coefficients(from.at.span), from.at.t);
  const double speed = std::sqrt(from.speed_squared);
  if (speed <= curve.spans()[from.at.span].rest) return false;
  double s = settings.chord / from.speed_squared * speed;  // (P9)
  NewtonEnd end{from.at, 0.0, std::numeric_limits<double>::infinity(), speed, 0};
  for (;; ++end.updates) {
    end.at.t = from.at.t + s;
    if (!(s > 0.0 && end.at.t < 1.0)) return false;
    const auto value = local.at(s, settings.chord);
    end.residual = settings.chord - value.length;
    if (end.updates == settings.max_iterations ||
        std::abs(end.residual) < settings.tolerance * settings.chord) {
      break;
    }
    if (!(value.growth > 0.0)) return false;
    end.previous = std::abs(end.residual);
    s += value.update;  // (P8)
  }
  if (!stands(curve, from, end, settings)) return false;
  // Member by member: a copy as a whole waits for its parts (see run() in interpolate.cpp).
  const LocalPoint point = curve.local(end.at);
  step.to.at.span = end.at.span;
  step.to.at.t = end.at.t;
  step.to.point.position.v = point.position.v;
  step.to.point.first.v = point.first.v;
  step.to.speed_squared = kRational ? dot(point.first, point.first) : local.speed_squared(s);
  step.evaluations = end.updates + 1;
  return true;
}

bool take_local_step(const Curve& curve, const Stand& from, const ChordSettings& settings,
                     ChordStep& step) {
  const bool rational = curve.spans()[from.at.span].rational;
  const auto take = [&]<int kDegree>() {
    return rational ? take_local_step<kDegree, true>(curve, from, settings, step)
                    : take_local_step<kDegree, false>(curve, from, settings, step);
  };
  switch (curve.degree()) {
    case 1:
      return take.template operator()<1>();
    case 2:
      return take.template operator()<2>();
    case 3:
      return take.template operator()<3>();
    case 4:
      return take.template operator()<4>();
    case 5:
      return take.template operator()<5>();
    default:
      return false;  // Q costs degree^2: from here on the curve itself is cheaper
  }
}

/// (P8) and (P9) on the curve itself, across spans.
ChordStep newton_step_across_spans(const Curve& curve, const Stand& from,
                                   const ChordSettings& settings) {
  const double chord = settings.chord;
  const double speed = std::sqrt(from.speed_squared);
  const double start = chord / from.speed_squared * speed;  // (P9)
  if (speed <= curve.spans()[from.at.span].rest || !std::isfinite(start)) {
    return search_step(curve, from, chord, 0);
  }
  ChordStep step;
  ChordFrame frame(curve, from);
  Cursor at{from.at.span, from.at.t + start};
  NewtonEnd end{at, 0.0, std::numeric_limits<double>::infinity(), speed, 0};
  for (;; ++end.updates) {
    at = curve.settle(at);
    step.to = stand_at(curve, at);
    ++step.evaluations;
    const Homogeneous reach = frame.chord_to(at, step.to.point);
    const double length = std::sqrt(dot(reach, reach));
    end.residual = chord - length;
    if (end.updates == settings.max_iterations ||
        std::abs(end.residual) < settings.tolerance * chord) {
      break;
    }
    const double growth = dot(reach, step.to.point.first);
    const bool beyond = end.residual > 0.0 && curve.at_end(at);
    if (!(growth > 0.0) || beyond) return search_step(curve, from, chord, step.evaluations);
    end.previous = std::abs(end.residual);
    at.t += end.residual * length / growth;  // (P8)
  }
  end.at = at;
  if (stands(curve, from, end, settings)) return step;
  return search_step(curve, from, chord, step.evaluations);
}

}  // namespace

double chord_length(const Curve& curve, const Stand& from, const Stand& to) {
  const Homogeneous chord = ChordFrame(curve, from).chord_to(to.at, to.point);
  return std::sqrt(dot(chord, chord));
}

ChordStep newton_step(const Curve& curve, const Stand& from, const ChordSettings& settings) {
  ChordStep step;
  if (take_local_step(curve, from, settings, step)) return step;
  return newton_step_across_spans(curve, from, settings);
}

ChordStep first_root_step(const Curve& curve, const Stand& from, double chord) {
  ChordStep step;
  const RootBracket root = first_chord_root(curve, from.at, from.point.position, chord);
  if (!root.found) {
    const Cursor end{curve.spans().size() - 1, 1.0};
    step.to = stand_at(curve, end);
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
    const Stand here = stand_at(curve, at);
    ++step.evaluations;
    const Homogeneous reach = frame.chord_to(at, here.point);
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
