// SPDX-License-Identifier: MIT
#include "path/interpolate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <new>
#include <utility>

#include "core/error.h"
#include "core/watch.h"
#include "path/arc_length_table.h"
#include "path/chord_step.h"
#include "path/parameter_step.h"

namespace millstudy::path {
namespace {

// A rest of the curve this short, in last parameter steps, is joined to the last step: always, and
// where rounding explains it.
constexpr double kJoinedRest = 1e-10;
constexpr double kLongestJoin = 1e-9;
constexpr int kMostIterations = 1000;

void refuse_bad_settings(const InterpolationSettings& s) {
  std::vector<core::Fault> found;
  const auto check = [&](bool good, std::string text) {
    if (!good) found.push_back({{}, std::move(text)});
  };
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  check(positive(s.feed_rate), fmt::format("feed_rate = {} mm/s must be > 0", s.feed_rate));
  check(positive(s.period), fmt::format("interpolation period = {} s must be > 0", s.period));
  check(s.max_iterations >= 1 && s.max_iterations <= kMostIterations,
        fmt::format("max_iterations = {} must be 1 to {}", s.max_iterations, kMostIterations));
  check(s.tolerance >= 0.0 && s.tolerance < 1.0,
        fmt::format("tolerance = {} of the wanted chord must be in [0, 1)", s.tolerance));
  check(s.steps >= 1 && s.steps <= kMostSteps,
        fmt::format("steps = {} must be 1 to {}", s.steps, kMostSteps));
  check(s.table_size >= 1 && s.table_size <= kMostSteps,
        fmt::format("table_size = {} must be 1 to {}", s.table_size, kMostSteps));
  if (!found.empty()) throw core::InputError(std::move(found));
}

[[noreturn]] void refuse_so_many_steps() {
  throw core::CaseError("the path takes more than 10 million interpolation steps");
}

/// Collects the steps of a path.
class PathWriter {
 public:
  PathWriter(const Curve& curve, const InterpolationSettings& settings) : curve_(curve) {
    out_.period = settings.period;
    out_.wanted_chord = settings.feed_rate * settings.period;
    const bool counted = settings.method == Method::uniform_parameter;
    const double expected = counted ? settings.steps : curve.length() / out_.wanted_chord;
    if (!(expected <= kMostSteps)) refuse_so_many_steps();
    out_.points.reserve(static_cast<std::size_t>(expected) + 8);
    out_.parameters.reserve(static_cast<std::size_t>(expected) + 8);
  }

  Stand begin() {
    const Stand start = stand_at(curve_, {0, -1.0});
    out_.curve_evaluations = 1;
    append(start, curve_.begin());
    return start;
  }

  /// The parameter where the tool stands, and the step that led there.
  double parameter() const { return out_.parameters.back(); }
  double last_step() const {
    const std::size_t n = out_.parameters.size();
    return n < 2 ? 0.0 : out_.parameters[n - 1] - out_.parameters[n - 2];
  }

  /// Takes a step in and moves its end to the double that stands for its parameter, so that the
  /// next chord starts where the reader of the parameters finds it. False at the end of the path.
  bool add(const Stand& from, ChordStep& step) {
    out_.curve_evaluations += step.evaluations;
    out_.fallback_steps += step.fallback ? 1 : 0;
    if (out_.points.size() > kMostSteps) refuse_so_many_steps();
    if (step.ended) {
      const double chord = chord_length(curve_, from, step.to);
      append(step.to, curve_.end());
      out_.partial = is_partial(chord, out_.wanted_chord);
      out_.full_steps += out_.partial ? 0 : 1;
      return false;
    }
    const double before = parameter();
    // Two places that round to one parameter: time goes on, so must u.
    double u = curve_.parameter(step.to.at);
    if (!(u > before)) u = std::nextafter(before, HUGE_VAL);
    const double rest = curve_.end() - u;
    const double spacing = std::numeric_limits<double>::epsilon() * std::abs(curve_.end());
    // A curve of a whole number of chords is missed by no more than the rounding of every step. Of
    // very many steps that would be a length one can see: it is then left as a partial step.
    const double rounding = spacing * static_cast<double>(out_.full_steps + 2);
    const double joined =
        std::clamp(rounding, kJoinedRest * (u - before), kLongestJoin * (u - before));
    const bool last = !(rest > joined);
    ++out_.full_steps;
    if (last) {
      append(stand_at(curve_, {curve_.spans().size() - 1, 1.0}), curve_.end());
      return false;
    }
    move_to(step.to, u);
    append(step.to, u);
    return true;
  }

  Interpolation take() { return std::move(out_); }
  void count_evaluations(std::int64_t count) { out_.curve_evaluations += count; }
  double chord() const { return out_.wanted_chord; }

 private:
  void move_to(Stand& stand, double u) const {
    const Span& span = curve_.spans()[stand.at.span];
    const double t = (u - span.middle) * span.inverse_half;
    stand.point.position = stand.point.position + stand.point.first * (t - stand.at.t);
    stand.at.t = t;
  }

  void append(const Stand& stand, double u) {
    out_.points.push_back(curve_.spans()[stand.at.span].origin + stand.point.position.xyz());
    out_.parameters.push_back(u);
  }

  const Curve& curve_;
  Interpolation out_;
};

/// Steps until the end; take_step(stand) gives the next one.
///
/// Two steps lie side by side and each is made in its place. Copying one would read as a whole
/// what was just written in parts, and wait for it: 93 for 57 ns a step.
template <class TakeStep>
Interpolation run(PathWriter& path, const TakeStep& take_step) {
  std::array<ChordStep, 2> steps;
  steps[0].to = path.begin();
  while (true) {
    core::keep_watch();
    for (std::size_t i = 0; i < 1024; ++i) {
      const std::size_t now = i % 2;
      const Stand& stand = steps[now].to;
      ChordStep* next = ::new (&steps[1 - now]) ChordStep(take_step(stand));
      if (!path.add(stand, *next)) return path.take();
    }
  }
}

Interpolation run_uniform(const Curve& curve, PathWriter& path, int steps) {
  const double width = curve.end() - curve.begin();
  int i = 0;
  return run(path, [&](const Stand& from) {
    ++i;
    ChordStep step;
    const double u = i == steps ? curve.end() : curve.begin() + width * i / steps;
    step.to = stand_at(curve, curve.locate(u, from.at.span));
    step.evaluations = 1;
    return step;
  });
}

Interpolation run_table(const Curve& curve, PathWriter& path, int intervals) {
  const ArcLengthTable table(curve, intervals);
  path.count_evaluations(table.evaluations());
  std::size_t hint = 0;
  std::int64_t i = 0;
  return run(path, [&](const Stand& from) {
    const double s = static_cast<double>(++i) * path.chord();
    ChordStep step;
    step.ended = s > table.length() * (1.0 + 1e-14);
    const double u = step.ended ? curve.end() : table.parameter(s, hint);
    step.to = stand_at(curve, curve.locate(u, from.at.span));
    step.evaluations = 1;
    return step;
  });
}

Interpolation run_predictor_corrector(const Curve& curve, PathWriter& path,
                                      const ChordSettings& chord) {
  StepHistory history;
  return run(path, [&](const Stand& from) {
    history.before_last = history.last;
    history.last = path.last_step();
    return history.last > 0.0 ? predictor_corrector_step(curve, from, history, chord)
                              : newton_step(curve, from, chord);
  });
}

}  // namespace

Interpolation interpolate(const Curve& curve, const InterpolationSettings& settings) {
  refuse_bad_settings(settings);
  PathWriter path(curve, settings);
  const ChordSettings chord{path.chord(), settings.max_iterations, settings.tolerance};
  switch (settings.method) {
    case Method::uniform_parameter:
      return run_uniform(curve, path, settings.steps);
    case Method::arc_length_table:
      return run_table(curve, path, settings.table_size);
    case Method::predictor_corrector:
      return run_predictor_corrector(curve, path, chord);
    case Method::taylor1:
      return run(path, [&](const Stand& from) { return taylor1_step(curve, from, chord.chord); });
    case Method::taylor2:
      return run(path, [&](const Stand& from) { return taylor2_step(curve, from, chord.chord); });
    case Method::newton:
      break;
  }
  return run(path, [&](const Stand& from) { return newton_step(curve, from, chord); });
}

}  // namespace millstudy::path
