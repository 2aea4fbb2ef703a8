// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <fmt/core.h>
#include <limits>

#include "core/error.h"
#include "core/units.h"
#include "dynamics/depth_limit.h"
#include "dynamics/floquet.h"
#include "dynamics/time_domain.h"
#include "dynamics/zeroth_order.h"
#include "study/kinds.h"
#include "study/rules.h"

namespace millstudy::study {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kIntervalsKept = 4;  // of stable depth

std::vector<sweep::Column> columns(const Outputs& outputs) {
  std::vector<sweep::Column> all = {
      {"stable", "1", "stable cut"},
      {"spectral_radius", "1", "growth of a disturbance over a period", true},
      {"multiplier_real", "1", "dominant multiplier, real part", true},
      {"multiplier_imaginary", "1", "dominant multiplier, imaginary part", true},
      {"chatter_frequency", "Hz", "strongest frequency of the dominant motion", true},
  };
  if (outputs.depth_is_axis) return all;
  all.push_back({"axial_depth_limit", "mm", "limit of axial depth"});
  all.push_back({"chatter_frequency_at_limit", "Hz", "chatter frequency at that boundary", true});
  all.push_back({"stable_depths", "1", "intervals of stable axial depth"});
  for (int i = 1; i <= kIntervalsKept; ++i) {
    const auto name = [&](const char* end) { return fmt::format("stable_depth_{}_{}", i, end); };
    const auto words = [&](const char* end) {
      return fmt::format("axial depth at which stable interval {} {}", i, end);
    };
    all.push_back({name("from"), "mm", words("begins"), true});
    all.push_back({name("to"), "mm", words("ends"), true});
  }
  return all;
}

/// What one point finds, in the order of the columns.
struct Found {
  bool stable = false;
  double radius = kNone;
  std::complex<double> multiplier = {kNone, kNone};
  double chatter_frequency = kNone;  // [rad/s]
  double limit = kNone;
  double frequency_at_limit = kNone;  // [rad/s]
  std::vector<dynamics::StableDepths> depths;
};

void fill(const Found& found, bool depth_is_axis, std::span<double> row) {
  std::fill(row.begin(), row.end(), kNone);
  std::size_t c = 0;
  row[c++] = found.stable ? 1.0 : 0.0;
  row[c++] = found.radius;
  row[c++] = found.multiplier.real();
  row[c++] = found.multiplier.imag();
  row[c++] = found.chatter_frequency / core::kTurn;
  if (depth_is_axis) return;
  row[c++] = found.limit;
  row[c++] = found.frequency_at_limit / core::kTurn;
  row[c++] = static_cast<double>(found.depths.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(kIntervalsKept, found.depths.size()); ++i) {
    row[c++] = found.depths[i].from;
    row[c++] = found.depths[i].to;
  }
}

/// The depth to which limits are sought; throws core::CaseError for one that the cutter lacks.
double largest_depth(const Case& point) {
  const std::optional<double>& asked = point.stability.largest_depth;
  const double usual = std::max(point.cutter.diameter, point.cut.axial_depth);
  const double longest =
      std::min(point.cutter.flute_length.value_or(1e300), cutter::Envelope(point.cutter).length());
  if (asked && *asked > longest) {
    throw core::CaseError("stability.largest_depth_mm must be <= the length of the flutes");
  }
  return asked.value_or(std::min(usual, longest));
}

/// The modes; the zeroth order takes measured responses as they are.
dynamics::Machine checked_machine(const Case& point) {
  if (point.stability.method == StabilityMethod::zeroth_order) return {};
  dynamics::Machine all = machine(point);
  dynamics::check(all);
  return all;
}

/// One point of any method.
class StabilityCase {
 public:
  StabilityCase(const Case& point, bool depth_is_axis)
      : point_(point),
        depth_is_axis_(depth_is_axis),
        machine_(checked_machine(point)),
        engagement_(engagement(point)),
        coefficients_(scaled_coefficients(point)),
        variation_(variation(point)),
        speed_(core::kTurn * point.cut.spindle_speed) {}

  Found find() const {
    switch (point_.stability.method) {
      case StabilityMethod::zeroth_order:
        return by_average();
      case StabilityMethod::time_domain:
        return by_simulation();
      default:
        return by_multipliers();
    }
  }

 private:
  force::Engagement at(double depth) const {
    return {engagement_.entry_angle, engagement_.exit_angle, depth};
  }

  dynamics::DelaySystem system(double depth) const {
    return dynamics::delay_system(machine_, {point_.cutter, at(depth), coefficients_, variation_},
                                  speed_, point_.law.process_damping);
  }

  Found by_multipliers() const {
    const StabilitySection& asked = point_.stability;
    const dynamics::FloquetSettings settings = {asked.tolerance, asked.intervals, asked.order};
    const dynamics::Floquet own = dynamics::floquet(system(engagement_.axial_depth), settings);
    Found found;
    found.radius = own.spectral_radius;
    found.stable = own.spectral_radius < 1.0;
    found.multiplier = own.multiplier;
    found.chatter_frequency = own.chatter_frequency;
    if (depth_is_axis_) return found;
    dynamics::DepthSearch search;
    search.largest_depth = largest_depth(point_);
    search.tolerance = std::max(asked.tolerance, 1e-8);
    search.intervals = asked.intervals;
    search.order = asked.order;
    const dynamics::DepthLimits limits =
        dynamics::depth_limits([this](double depth) { return system(depth); }, search, own.level);
    found.limit = limits.axial_depth_limit;
    found.depths = limits.stable;
    if (found.limit > 0.0 && found.limit < search.largest_depth) {
      found.frequency_at_limit =
          dynamics::floquet(system(found.limit), settings, limits.level).chatter_frequency;
    }
    return found;
  }

  Found by_average() const {
    const double deepest = depth_is_axis_
                               ? engagement_.axial_depth
                               : std::max(largest_depth(point_), engagement_.axial_depth);
    const dynamics::ZerothOrderLimit limit = dynamics::zeroth_order_limit(
        frequency_domain(point_), point_.cutter, engagement_.arc(), coefficients_, speed_, deepest,
        variation_, point_.law.process_damping);
    Found found;
    found.limit = limit.axial_depth_limit;
    found.depths = {{0.0, found.limit}};
    found.stable = engagement_.axial_depth < found.limit || found.limit == deepest;
    if (limit.chatter_frequency > 0.0) {
      found.chatter_frequency = found.frequency_at_limit = limit.chatter_frequency;
    }
    return found;
  }

  dynamics::Simulated simulated(double depth) const {
    dynamics::TimeDomain settings;
    settings.feed_per_tooth = feed_per_tooth(point_);
    settings.revolutions = point_.stability.revolutions;
    settings.process_damping = point_.law.process_damping;
    return dynamics::simulate(machine_, point_.cutter, at(depth), coefficients_, speed_, settings,
                              variation_);
  }

  Found by_simulation() const {
    const dynamics::Simulated own = simulated(engagement_.axial_depth);
    Found found;
    found.stable = own.stable;
    const bool by_tooth =
        cutter::has_equal_flutes(point_.cutter) && !cutter::has_runout(point_.cutter);
    const double periods = by_tooth ? point_.cutter.flutes : 1.0;  // in a turn
    if (!own.saturated) found.radius = std::exp(own.growth_per_turn / periods);
    if (depth_is_axis_) return found;
    // The lowest change of the verdict, upwards from what is nearly no cut.
    const double deepest = largest_depth(point_);
    constexpr int kDepths = 12;
    double low = 0.0, high = deepest;
    bool unstable = false;
    for (int i = 1; i <= kDepths && !unstable; ++i) {
      high = deepest * std::pow(static_cast<double>(i) / kDepths, 1.5);
      unstable = !simulated(high).stable;
      if (!unstable) low = high;
    }
    while (unstable && high - low > point_.stability.tolerance * high && high > 1e-4 * deepest) {
      const double middle = 0.5 * (low + high);
      (simulated(middle).stable ? low : high) = middle;
    }
    found.limit = unstable ? 0.5 * (low + high) : deepest;
    found.depths = {{0.0, found.limit}};
    return found;
  }

  const Case& point_;
  bool depth_is_axis_;
  dynamics::Machine machine_;
  force::Engagement engagement_;
  force::Coefficients coefficients_;
  force::Variation variation_;
  double speed_;  // [rad/s]
};

EvaluatePoint make_evaluator(const Outputs& outputs) {
  return [depth_is_axis = outputs.depth_is_axis](const Case& point, std::span<double> row,
                                                 sweep::Trace*) {
    check_point_coefficients(point);
    check_point_cutter(point);
    check_feed(point);
    fill(StabilityCase(point, depth_is_axis).find(), depth_is_axis, row);
  };
}

bool may_be(const Given& given, StabilityMethod method) {
  constexpr std::string_view kMethod = "stability.method";
  constexpr std::array<std::string_view, 3> kNames = {"semi_discretization", "zeroth_order",
                                                      "time_domain"};
  if (!given.has(kMethod)) return method == StabilityMethod::semi_discretization;
  return given.may_be(kMethod, kNames[static_cast<std::size_t>(method)]);
}

void check_keys(const Given& given, const Case& base, Faults& faults) {
  check_cutter_keys(given, faults);
  check_coefficient_keys(given, faults);
  check_engagement_keys(given, base, faults);
  check_modes_keys(given, faults);
  const bool rate = given.has("cut.feed_rate_mm_per_min");
  const bool tooth = given.has("cut.feed_per_tooth_mm");
  if (rate && tooth) {
    faults.add(given.place({"cut.feed_per_tooth_mm"}),
               "cut.feed_per_tooth_mm contradicts cut.feed_rate_mm_per_min: give one of them");
  }
  if (may_be(given, StabilityMethod::time_domain) && !rate && !tooth) {
    faults.add(given.place({"stability.method"}),
               "cut.feed_rate_mm_per_min [mm/min] or cut.feed_per_tooth_mm [mm] is missing: "
               "time_domain needs it");
  }
  if (given.has("stability.order") && !given.has("stability.intervals")) {
    faults.add(given.place({"stability.order"}),
               "stability.intervals is missing: stability.order is that of so many intervals");
  }
  if (given.has("stability.tolerance") && given.has("stability.intervals")) {
    faults.add(given.place({"stability.intervals"}),
               "stability.intervals contradicts stability.tolerance: give one of them");
  }
  if (given.has("stability.largest_depth_mm") && given.swept("cut.axial_depth_mm")) {
    faults.add(given.place({"stability.largest_depth_mm"}),
               "stability.largest_depth_mm is not used where cut.axial_depth_mm is an axis: leave "
               "it out");
  }
  const bool linear = may_be(given, StabilityMethod::semi_discretization) ||
                      may_be(given, StabilityMethod::zeroth_order);
  if (!linear) return;
  check_linear_keys(given, base, "stability.method", faults);
}

void check_values(const Given& given, const Case& base, Faults& faults) {
  check_cutter(given, base, faults);
  check_coefficients(given, base, faults);
  check_cut(given, base, faults);
  if (may_be(given, StabilityMethod::semi_discretization) ||
      may_be(given, StabilityMethod::time_domain)) {
    check_modes(given, base, faults);
  }
  if (given.has("stability.largest_depth_mm") && !given.section_swept("cutter")) {
    try {
      largest_depth(base);
    } catch (const core::CaseError& error) {
      faults.add(given.place({"stability.largest_depth_mm"}), error.what());
    } catch (const core::InputError&) {
      // The cutter is at fault, which check_cutter() tells.
    }
  }
}

}  // namespace

const Kind& stability_kind() {
  static const Kind kind = {
      .name = "stability",
      .help = "whether a cut chatters, at which frequency, and how deep it may go",
      .sections = {general_keys(), cutter_keys(), coefficient_keys(), cut_keys(), modes_keys(),
                   stability_keys()},
      .columns = columns,
      .has_traces = false,
      .check_keys = check_keys,
      .check = check_values,
      .notes = fitted_modes,
      .make_evaluator = make_evaluator,
  };
  return kind;
}

}  // namespace millstudy::study
