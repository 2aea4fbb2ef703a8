// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "core/error.h"
#include "core/units.h"
#include "dynamics/floquet.h"
#include "dynamics/forced_vibration.h"
#include "dynamics/regenerative_cut.h"
#include "dynamics/surface.h"
#include "dynamics/time_domain.h"
#include "force/force_basis.h"
#include "study/kinds.h"
#include "study/rules.h"

namespace millstudy::study {
namespace {

constexpr double kUm = 1e3;             // in a mm
constexpr int kHeights = 33;            // of the extremes over height
constexpr int kSamplesPerTooth = 1024;  // of the profile: Rz to 0.2 %

std::vector<sweep::Column> columns(const Outputs&) {
  return {
      {"stable", "1", "stable cut"},
      {"spectral_radius", "1", "growth of a disturbance over a period", true},
      {"surface_location_error", "um", "surface location error", true},
      {"surface_location_error_min", "um", "lowest surface location error over the height", true},
      {"surface_location_error_max", "um", "highest surface location error over the height", true},
      {"roughness_ra", "um", "roughness Ra of the wall along the feed", true},
      {"roughness_rq", "um", "roughness Rq of the wall along the feed", true},
      {"roughness_rz", "um", "roughness Rz of the wall along the feed", true},
      {"cusp_height", "um", "height of the cusps between passes", true},
      {"vibration_x_peak_to_peak", "um", "forced vibration of the tool along x", true},
      {"vibration_y_peak_to_peak", "um", "forced vibration of the tool along y", true},
  };
}

dynamics::Wall wall(const Case& point, const force::Arc& arc) {
  const bool up = arc.entry_angle<1e-9, down = arc.exit_angle> core::kPi - 1e-9;
  switch (point.finish.wall) {
    case FinishWall::up:
      if (up) return dynamics::Wall::up;
      throw core::CaseError("finish.wall = \"up\" needs teeth that enter at immersion 0");
    case FinishWall::down:
      if (down) return dynamics::Wall::down;
      throw core::CaseError("finish.wall = \"down\" needs teeth that leave at immersion 180 deg");
    default:
      if (!up && !down) {
        throw core::CaseError(
            "this cut leaves no wall: teeth neither enter at 0 nor leave at 180 deg");
      }
      return up ? dynamics::Wall::up : dynamics::Wall::down;
  }
}

/// Height at which the wall is measured [mm].
double height(const Case& point) {
  const double depth = point.cut.axial_depth;
  if (point.finish.height.value_or(0.0) > depth) {
    throw core::CaseError("finish.height_mm must be <= cut.axial_depth_mm");
  }
  return point.finish.height.value_or(0.5 * depth);
}

struct Vibration {
  bool stable = false;
  double radius = std::numeric_limits<double>::quiet_NaN();
  dynamics::PeriodicMotion motion;
};

Vibration periodic(const Case& point, const dynamics::Machine& machine,
                   const force::Engagement& engaged, double speed) {
  const force::Coefficients coefficients = scaled_coefficients(point);
  const force::Variation law = variation(point);
  const dynamics::DelaySystem system = dynamics::delay_system(
      machine, {point.cutter, engaged, coefficients, law}, speed, point.law.process_damping);
  Vibration found{false, dynamics::floquet(system, {}).spectral_radius,
                  dynamics::PeriodicMotion(system.period)};
  found.stable = found.radius < 1.0;
  if (!found.stable) return found;
  const force::Feed feed = {feed_per_tooth(point)};
  const auto force_at = [&](double t) {
    const std::array<double, force::kRows> rows = force::evaluate(
        force::force_basis(point.cutter, engaged, {}, speed * t, law), coefficients, feed);
    return Eigen::Vector2d(rows[0], rows[1]);
  };
  found.motion = dynamics::forced_vibration(system, force_at, point.finish.tolerance);
  return found;
}

Vibration simulated(const Case& point, const dynamics::Machine& machine,
                    const force::Engagement& engaged, double speed) {
  dynamics::TimeDomain settings;
  settings.feed_per_tooth = feed_per_tooth(point);
  settings.revolutions = point.finish.revolutions;
  settings.process_damping = point.law.process_damping;
  const dynamics::Simulated found =
      dynamics::simulate(machine, point.cutter, engaged, scaled_coefficients(point), speed,
                         settings, variation(point));
  return {found.stable, std::numeric_limits<double>::quiet_NaN(),
          dynamics::PeriodicMotion(core::kTurn / speed, found.last_turn)};
}

/// Largest less smallest displacement, x and y [mm].
Eigen::Vector2d peak_to_peak(const dynamics::PeriodicMotion& motion) {
  constexpr int kPlaces = 720;
  Eigen::Vector2d low = motion.at(0.0), high = low;
  for (int i = 1; i < kPlaces; ++i) {
    const Eigen::Vector2d place = motion.at(motion.period() * i / kPlaces);
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return high - low;
}

void evaluate(const Case& point, std::span<double> row, sweep::Trace*) {
  check_point_coefficients(point);
  check_point_cutter(point);
  check_feed(point);
  const force::Engagement engaged = engagement(point);
  const dynamics::Wall side = wall(point, engaged.arc());
  const double z = height(point), speed = core::kTurn * point.cut.spindle_speed;
  dynamics::Machine all = machine(point);
  dynamics::check(all);
  const Vibration vibration = point.finish.method == FinishMethod::periodic
                                  ? periodic(point, all, engaged, speed)
                                  : simulated(point, all, engaged, speed);
  std::fill(row.begin(), row.end(), std::numeric_limits<double>::quiet_NaN());
  row[0] = vibration.stable ? 1.0 : 0.0;
  row[1] = vibration.radius;
  const force::CuttingEdges edges(point.cutter, engaged.axial_depth, variation(point));
  if (point.finish.stepover) {
    row[8] = kUm * dynamics::cusp_height(edges.envelope(), *point.finish.stepover);
  }
  if (!vibration.stable) return;
  const dynamics::MachinedWall surface(edges, vibration.motion, speed, feed_per_tooth(point), side);
  row[2] = kUm * surface.location_error(z);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int i = 0; i < kHeights; ++i) {
    const double error = surface.location_error(engaged.axial_depth * i / (kHeights - 1));
    low = std::min(low, error);
    high = std::max(high, error);
  }
  row[3] = kUm * low;
  row[4] = kUm * high;
  const int samples = kSamplesPerTooth * point.cutter.flutes;
  const dynamics::Roughness rough = dynamics::roughness(
      surface.profile(z, samples), surface.feed_per_turn(), point.finish.sampling_length);
  row[5] = kUm * rough.ra;
  row[6] = kUm * rough.rq;
  row[7] = kUm * rough.rz;
  const Eigen::Vector2d swing = peak_to_peak(vibration.motion);
  row[9] = kUm * swing[0];
  row[10] = kUm * swing[1];
}

void check_keys(const Given& given, const Case& base, Faults& faults) {
  check_force_keys(given, base, faults);
  check_modes_keys(given, faults);
  const bool periodic = !given.has("finish.method") || given.may_be("finish.method", "periodic");
  if (periodic) check_linear_keys(given, base, "finish.method", faults);
}

void check_values(const Given& given, const Case& base, Faults& faults) {
  check_cutter(given, base, faults);
  check_coefficients(given, base, faults);
  check_cut(given, base, faults);
  check_modes(given, base, faults);
  const auto look = [&](std::initializer_list<std::string_view> keys, const auto& rule) {
    if (given.any_swept(keys)) return;
    try {
      rule();
    } catch (const core::CaseError& error) {
      faults.add(given.place(keys), error.what());
    } catch (const core::InputError&) {
      // The cutter or the cut is at fault, which its own checks tell.
    }
  };
  look({"finish.height_mm", "cut.axial_depth_mm"}, [&] { height(base); });
  look({"finish.wall", "cut.milling", "cut.entry_deg", "cut.exit_deg", "cut.radial_depth_mm",
        "cutter.diameter_mm"},
       [&] { wall(base, engagement(base).arc()); });
  if (base.finish.stepover && !given.section_swept("cutter")) {
    look({"finish.stepover_mm"},
         [&] { dynamics::cusp_height(cutter::Envelope(base.cutter), *base.finish.stepover); });
  }
}

}  // namespace

const Kind& finish_kind() {
  static const Kind kind = {
      .name = "finish",
      .help = "the surface that the forced vibration of a stable cut leaves on its wall",
      .sections = {general_keys(), cutter_keys(), coefficient_keys(), cut_keys(), modes_keys(),
                   finish_keys()},
      .columns = columns,
      .has_traces = false,
      .check_keys = check_keys,
      .check = check_values,
      .notes = fitted_modes,
      .make_evaluator = [](const Outputs&) { return EvaluatePoint(evaluate); },
  };
  return kind;
}

}  // namespace millstudy::study
