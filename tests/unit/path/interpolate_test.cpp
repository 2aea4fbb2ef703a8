// SPDX-License-Identifier: MIT
#include "path/interpolate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/error.h"
#include "path/figures.h"
#include "path/reference_curve.h"
#include "unit/path/test_curves.h"

namespace millstudy::path {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

InterpolationSettings with_chord(double chord, Method method = Method::newton, int n = 20) {
  InterpolationSettings settings;
  settings.method = method;
  settings.period = 0.002;
  settings.feed_rate = chord / settings.period;
  settings.max_iterations = n;
  return settings;
}

/// Random curves to try; MILLSTUDY_RANDOM_FACTOR multiplies it for a long run.
unsigned random_count(unsigned usual) {
  const char* factor = std::getenv("MILLSTUDY_RANDOM_FACTOR");
  return factor ? usual * static_cast<unsigned>(std::max(1, std::atoi(factor))) : usual;
}

/// What any path of any method must be.
void expect_sound(const Curve& curve, const Interpolation& path, const std::string& what) {
  ASSERT_EQ(path.points.size(), path.parameters.size()) << what;
  ASSERT_EQ(path.points.size(), path.full_steps + (path.partial ? 2U : 1U)) << what;
  EXPECT_EQ(path.parameters.front(), curve.begin()) << what;
  EXPECT_EQ(path.parameters.back(), curve.end()) << what;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    ASSERT_TRUE(std::isfinite(dot(path.points[i], path.points[i]))) << what;
    if (i == 0) continue;
    ASSERT_GT(path.parameters[i], path.parameters[i - 1]) << what << " step " << i;
  }
  const PathFigures f = path_figures(curve, path);
  for (const double v : {f.feed_fluctuation_max, f.feed_fluctuation_rms, f.feed_fluctuation_l2,
                         f.path_length, f.path_time, f.chord_error_max}) {
    ASSERT_TRUE(std::isfinite(v)) << what;
  }
}

/// How far u may be from the double next to it: what the rounding of u costs in the chord.
double rounding(const ReferenceCurve& curve, double u, double chord, double size) {
  const double spacing = kEpsilon * std::max({std::abs(u), std::abs(curve.begin()), 1.0});
  return (2.0 * spacing * norm(curve.evaluate(u, 1).first) + 200.0 * kEpsilon * size) / chord;
}

/// (P8) at every full step, and no earlier place of the step as far away: an exhaustive march.
void expect_first_roots(const CurveData& data, const Interpolation& path, const std::string& what,
                        double& worst) {
  const ReferenceCurve reference(data);
  double size = 0.0;
  for (const Vec3& p : data.points) size = std::max(size, norm(p - data.points.front()));
  const double chord = path.wanted_chord;
  const int samples = 400;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Vec3 from = reference.evaluate(path.parameters[i - 1], 0).position;
    const double u0 = path.parameters[i - 1];
    const double u1 = path.parameters[i];
    const bool full = static_cast<std::int64_t>(i) <= path.full_steps;
    const double slack =
        rounding(reference, u0, chord, size) + rounding(reference, u1, chord, size);
    if (full) {
      const double got = norm(reference.evaluate(u1, 0).position - from);
      const double off = std::abs(1.0 - got / chord);
      worst = std::max(worst, off - slack);
      // The rest that is joined to the last step may be the rounding of u over all steps.
      const bool last = i + 1 == path.points.size();
      const double joined = last ? static_cast<double>(path.full_steps) * slack : 0.0;
      ASSERT_LE(off, 1e-10 + slack + joined) << what << " step " << i << " of " << path.full_steps;
    }
    for (int k = 1; k < samples; ++k) {
      const double u = u0 + (u1 - u0) * k / samples;
      const double reach = norm(reference.evaluate(u, 0).position - from);
      ASSERT_LE(reach, chord * (1.0 + 1e-10 + slack))
          << what << " step " << i << (full ? "" : " (partial)") << " passed a root at " << u;
    }
  }
}

TEST(Newton, TakesTheFirstRootOfEveryStepOnRandomCurves) {
  double worst = 0.0;
  std::int64_t steps = 0;
  std::int64_t fallbacks = 0;
  for (unsigned seed = 0; seed < random_count(600); ++seed) {
    const CurveData data = test::random_curve(seed);
    const Curve curve(data);
    // From 200 steps down to chords longer than the curve.
    for (const double share : {0.005, 0.05, 0.3, 0.8, 1.5}) {
      const std::string what = fmt::format("seed {} share {}", seed, share);
      const Interpolation path = interpolate(curve, with_chord(share * curve.length()));
      expect_sound(curve, path, what);
      expect_first_roots(data, path, what, worst);
      if (HasFatalFailure()) return;
      steps += path.full_steps;
      fallbacks += path.fallback_steps;
    }
  }
  fmt::print("  {} steps, {} by the fallback, worst {:.2g} beyond rounding\n", steps, fallbacks,
             worst);
  EXPECT_GT(fallbacks, 500);  // the curves are wild enough to need it
}

TEST(EveryMethod, IsSoundOnRandomCurves) {
  for (unsigned seed = 0; seed < random_count(200); ++seed) {
    const Curve curve(test::random_curve(seed));
    for (const Method method :
         {Method::uniform_parameter, Method::taylor1, Method::taylor2, Method::predictor_corrector,
          Method::arc_length_table, Method::newton}) {
      for (const double share : {0.003, 0.1, 2.0}) {
        for (const int n : {1, 2, 3}) {
          const std::string what = fmt::format("seed {} method {} share {} N {}", seed,
                                               static_cast<int>(method), share, n);
          expect_sound(curve, interpolate(curve, with_chord(share * curve.length(), method, n)),
                       what);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

TEST(Newton, PassesACuspAndTurnsBack) {
  // (t^2, t^3) has a cusp in the middle; a line that runs back over itself has two.
  const CurveData cusp{3, bezier_knots(3), {{1, -1}, {-1.0 / 3, 1}, {-1.0 / 3, -1}, {1, 1}}, {}};
  const CurveData back = test::clamped(1, {{0, 0}, {10, 0}, {3, 0}, {8, 0}});
  const CurveData smooth_back = test::clamped(2, {{0, 0}, {10, 0}, {0, 0}});
  double worst = 0.0;
  for (const CurveData& data : {cusp, back, smooth_back}) {
    for (const double chord : {0.001, 0.0123, 0.4, 1.7, 4.9, 30.0}) {
      const Curve curve(data);
      const Interpolation path = interpolate(curve, with_chord(chord));
      expect_sound(curve, path, "cusp");
      expect_first_roots(data, path, fmt::format("chord {}", chord), worst);
    }
  }
}

TEST(Newton, WalksFromTheCentreOntoAnArcAtOneChord) {
  // From the centre to the circle and along it: the chord condition holds all along the arc, so
  // the first root is where the arc begins.
  const double r = std::sqrt(0.5);
  const CurveData data{
      2, {0, 0, 0, 1, 1, 2, 2, 2}, {{0, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}}, {1, 1, 1, r, 1}};
  const Interpolation path = interpolate(Curve(data), with_chord(10.0));
  ASSERT_GE(path.full_steps, 1);
  EXPECT_NEAR(path.parameters[1], 1.0, 1e-9);
}

TEST(Newton, EndsALineExactly) {
  const Curve line(test::data_curve("line", 2));
  const Interpolation path = interpolate(line, with_chord(0.1));
  EXPECT_EQ(path.full_steps, 1000);
  EXPECT_FALSE(path.partial);
  EXPECT_LT(path_figures(line, path).chord_error_max, 1e-13);
}

TEST(Newton, CutsNothingOffTheEndOfALongPath) {
  struct Line {
    double begin, length;
    std::int64_t steps;
  };
  // Knots far from zero, or very many steps, must not turn a rest into part of the last step.
  for (const Line& line : {Line{1e6, 100.0005, 100'000}, Line{1e6, 60.0003, 60'000},
                           Line{0.0, 1000.0002, 1'000'000}, Line{0.0, 100.00001, 100'000}}) {
    const Curve curve({1,
                       {line.begin, line.begin, line.begin + 1.0, line.begin + 1.0},
                       {{0.0, 0.0, 0.0}, {line.length, 0.0, 0.0}},
                       {}});
    const Interpolation path = interpolate(curve, with_chord(0.001));
    EXPECT_EQ(path.full_steps, line.steps);
    EXPECT_TRUE(path.partial);
    EXPECT_LT(path_figures(curve, path).feed_fluctuation_max, line.begin > 0.0 ? 0.1 : 1e-6);
  }
}

TEST(UniformParameter, TakesItsStepsWhereParametersAreCoarse) {
  const Curve curve(
      {1, {1e6, 1e6, 1e6 + 1.0, 1e6 + 1.0}, {{0.0, 0.0, 0.0}, {100.0, 0.0, 0.0}}, {}});
  InterpolationSettings settings = with_chord(0.001, Method::uniform_parameter);
  settings.steps = 1'000'000;
  const Interpolation path = interpolate(curve, settings);
  EXPECT_EQ(path.points.size(), 1'000'001U);
  EXPECT_NEAR(path_figures(curve, path).feed_fluctuation_max, 90.0, 0.1);
}

TEST(Newton, AChordLongerThanTheCurveIsOnePartialStep) {
  const Curve curve(test::butterfly());
  const Interpolation path = interpolate(curve, with_chord(1000.0));
  EXPECT_EQ(path.full_steps, 0);
  EXPECT_TRUE(path.partial);
  const PathFigures f = path_figures(curve, path);
  EXPECT_EQ(f.feed_fluctuation_max, 0.0);
  EXPECT_EQ(f.path_time, 0.002);
}

TEST(Newton, StopsAtItsTolerance) {
  const Curve curve(test::sun2008());
  InterpolationSettings settings = with_chord(0.12);
  settings.tolerance = 1e-4;
  const PathFigures f = path_figures(curve, interpolate(curve, settings));
  EXPECT_LT(f.feed_fluctuation_max, 1e-2);
  EXPECT_GT(f.feed_fluctuation_max, 1e-9);
  EXPECT_LT(f.curve_evaluations / f.steps, 3.0);
}

TEST(Newton, AFewIterationsAreNoReasonForTheFallback) {
  for (const CurveData& data : {test::sun2008(), test::butterfly(), test::trident()}) {
    for (int n = 1; n <= 5; ++n) {
      EXPECT_EQ(interpolate(Curve(data), with_chord(0.12, Method::newton, n)).fallback_steps, 0);
    }
  }
}

CurveData moved(CurveData data, double scale, double angle, const Vec3& shift) {
  for (Vec3& p : data.points) {
    const double x = std::cos(angle) * p.x - std::sin(angle) * p.y;
    const double y = std::sin(angle) * p.x + std::cos(angle) * p.y;
    p = scale * Vec3{x, y, p.z} + shift;
  }
  return data;
}

TEST(Figures, DoNotDependOnUnitsPlaceOrOrientation) {
  for (const CurveData& data : {test::sun2008(), test::butterfly()}) {
    for (const int n : {1, 2, 3, 6}) {
      const auto figures = [&](const CurveData& d, double chord) {
        const Curve curve(d);
        return path_figures(curve, interpolate(curve, with_chord(chord, Method::newton, n)));
      };
      const PathFigures here = figures(data, 0.12);
      // A shift by 1e4 mm rounds control points to 1.8e-12 mm; 1e-12 mm is 1e-9 percent of a chord.
      const PathFigures far = figures(moved(data, 1.0, 0.0, {1e4, -1e4, 1e4}), 0.12);
      const PathFigures turned = figures(moved(data, 1.0, 0.7, {}), 0.12);
      const PathFigures micro = figures(moved(data, 1e3, 0.0, {}), 120.0);
      const double floor = 100.0 * 1e-13;
      fmt::print("  N {}: {:.7g} shifted {:+.2g} turned {:+.2g} um {:+.2g}\n", n,
                 here.feed_fluctuation_max, far.feed_fluctuation_max - here.feed_fluctuation_max,
                 turned.feed_fluctuation_max - here.feed_fluctuation_max,
                 micro.feed_fluctuation_max - here.feed_fluctuation_max);
      const double value = here.feed_fluctuation_max;
      EXPECT_NEAR(far.feed_fluctuation_max, value, 1e-9 * value + floor);
      EXPECT_NEAR(turned.feed_fluctuation_max, value, 1e-9 * value + floor);
      EXPECT_NEAR(micro.feed_fluctuation_max, value, 1e-9 * value + floor);
      EXPECT_EQ(far.steps, here.steps);
      EXPECT_NEAR(micro.chord_error_max, 1e3 * here.chord_error_max, 1e-6);
    }
  }
}

TEST(Figures, ChordErrorIsTheSagittaOnACircle) {
  const Curve circle(test::data_curve("circle", 2));
  const PathFigures f = path_figures(circle, interpolate(circle, with_chord(1.0)));
  EXPECT_NEAR(f.chord_error_max, 10.0 - std::sqrt(100.0 - 0.25), 1e-10);
}

TEST(Figures, ChordErrorMatchesAFineScan) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const CurveData data = test::random_curve(seed);
    const Curve curve(data);
    const Interpolation path = interpolate(curve, with_chord(0.03 * curve.length()));
    const double reported = path_figures(curve, path).chord_error_max;
    double scanned = 0.0;
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      const Vec3 along = path.points[i] - path.points[i - 1];
      for (int k = 1; k < 2000; ++k) {
        const double share = k / 2000.0;
        const Vec3 arm =
            curve.position((1.0 - share) * path.parameters[i - 1] + share * path.parameters[i]) -
            path.points[i - 1];
        const double s = dot(along, along) > 0.0
                             ? std::clamp(dot(arm, along) / dot(along, along), 0.0, 1.0)
                             : 0.0;
        scanned = std::max(scanned, norm(arm - s * along));
      }
    }
    EXPECT_NEAR(reported, scanned, 1e-3 * scanned + 1e-13) << seed;
  }
}

TEST(Interpolate, RefusesMoreStepsThanItCanHold) {
  const Curve curve(test::sun2008());
  EXPECT_THROW(interpolate(curve, with_chord(1e-9)), core::CaseError);
  EXPECT_THROW(interpolate(curve, with_chord(1e-300)), core::CaseError);
}

TEST(Interpolate, RefusesSettingsOutOfRange) {
  const Curve curve(test::sun2008());
  const auto refused = [&](auto change) {
    InterpolationSettings s = with_chord(0.12);
    change(s);
    EXPECT_THROW(interpolate(curve, s), core::InputError);
  };
  refused([](InterpolationSettings& s) { s.feed_rate = 0.0; });
  refused([](InterpolationSettings& s) { s.feed_rate = std::nan(""); });
  refused([](InterpolationSettings& s) { s.period = -1.0; });
  refused([](InterpolationSettings& s) { s.max_iterations = 0; });
  refused([](InterpolationSettings& s) { s.tolerance = -1e-3; });
  refused([](InterpolationSettings& s) { s.steps = 0; });
  refused([](InterpolationSettings& s) { s.table_size = 2000000000; });
}

TEST(UniformParameter, TakesTheStepsItIsGiven) {
  const Curve curve(test::sun2008());
  InterpolationSettings s = with_chord(0.12, Method::uniform_parameter);
  s.steps = 123;
  const Interpolation path = interpolate(curve, s);
  EXPECT_EQ(path.full_steps, 123);
  EXPECT_FALSE(path.partial);
  EXPECT_NEAR(path.parameters[41], 41.0 / 123.0, 1e-16);
}

}  // namespace
}  // namespace millstudy::path
