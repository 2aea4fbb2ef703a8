// SPDX-License-Identifier: MIT
#include "study/case.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <memory>
#include <string_view>

#include "core/error.h"
#include "core/units.h"
#include "cutter/envelope.h"
#include "cutter/flutes.h"
#include "dynamics/zeroth_order.h"

namespace millstudy::study {

force::Coefficients scaled_coefficients(const Case& point) {
  const double chip = point.law.cutting_scale;
  const double edge = point.law.edge_scale;
  const force::Coefficients& k = point.coefficients;
  const force::Coefficients given = point.law.model == CoefficientModel::orthogonal
                                        ? force::Coefficients{1.0, 1.0, 1.0, k.Kte, k.Kre, k.Kae}
                                        : k;
  return {chip * given.Ktc, chip * given.Krc, chip * given.Kac,
          edge * given.Kte, edge * given.Kre, edge * given.Kae};
}

force::Variation variation(const Case& point) {
  const CoefficientLaw& law = point.law;
  const auto empty = [](const std::vector<double>& numbers) { return numbers.empty(); };
  force::Variation result;
  if (!std::all_of(law.height.table.begin(), law.height.table.end(), empty) ||
      !std::all_of(law.height.polynomial.begin(), law.height.polynomial.end(), empty)) {
    result.height = std::make_shared<const force::HeightFactors>(law.height);
  }
  if (law.model == CoefficientModel::orthogonal) {
    result.orthogonal = law.orthogonal;
  } else {
    result.size_exponent = law.size_exponent;
    result.reference_chip_thickness = law.reference_chip_thickness.value_or(1.0);
  }
  return result;
}

double feed_rate(const Case& point) {
  if (point.cut.feed_rate) return *point.cut.feed_rate;
  if (!point.cut.feed_per_tooth) return std::numeric_limits<double>::quiet_NaN();
  return *point.cut.feed_per_tooth * point.cut.spindle_speed * point.cutter.flutes;
}

double feed_per_tooth(const Case& point) {
  if (point.cut.feed_per_tooth) return *point.cut.feed_per_tooth;
  if (!point.cut.feed_rate) return std::numeric_limits<double>::quiet_NaN();
  return *point.cut.feed_rate / (point.cut.spindle_speed * point.cutter.flutes);
}

force::Engagement engagement(const Case& point) {
  const CutSection& cut = point.cut;
  if (cut.axial_depth > point.cutter.flute_length.value_or(cut.axial_depth)) {
    throw core::CaseError("cut.axial_depth_mm must be <= cutter.flute_length_mm");
  }
  if (cut.axial_depth > cutter::Envelope(point.cutter).length()) {
    throw core::CaseError("cut.axial_depth_mm must be <= the height of the cutter's envelope");
  }
  if (cut.axial_depth > force::largest_axial_depth(point.cutter)) {
    throw core::CaseError("cut.axial_depth_mm must be <= 1000 turns of the helix");
  }
  if (cut.axial_depth > point.stick_out.value_or(cut.axial_depth)) {
    throw core::CaseError("cut.axial_depth_mm must be <= cutter.stick_out_mm");
  }
  if (!cut.milling) {
    if (*cut.exit_angle <= *cut.entry_angle) {
      throw core::CaseError("cut.exit_deg must be > cut.entry_deg");
    }
    return {*cut.entry_angle, *cut.exit_angle, cut.axial_depth};
  }
  if (*cut.milling == Milling::slot) return force::slot(cut.axial_depth);
  if (*cut.radial_depth > point.cutter.diameter) {
    throw core::CaseError("cut.radial_depth_mm must be <= cutter.diameter_mm");
  }
  const double radius = 0.5 * point.cutter.diameter;
  return *cut.milling == Milling::up
             ? force::up_milling(radius, *cut.radial_depth, cut.axial_depth)
             : force::down_milling(radius, *cut.radial_depth, cut.axial_depth);
}

void check_feed(const Case& point) {
  if (!(feed_per_tooth(point) > cutter::radius(point.cutter))) return;
  throw core::CaseError(
      "feed per tooth must be <= the cutter's radius: check feed rate, spindle speed and flutes");
}

double cutting_speed(const Case& point) {
  return core::kPi * point.cutter.diameter * point.cut.spindle_speed;
}

double radial_immersion(const Case& point) {
  const force::Engagement arc = engagement(point);
  // (cos entry - cos exit) / 2, without losing the digits of a thin cut.
  return std::sin(0.5 * (arc.entry_angle + arc.exit_angle)) *
         std::sin(0.5 * (arc.exit_angle - arc.entry_angle));
}

double disc_samples(const Case& point) {
  if (point.edge_rule.rule != force::Rule::discs) return 0.0;
  const double discs = static_cast<double>(point.edge_rule.discs) * point.angular_steps;
  // With runout every disc of every flute looks at all flutes before it.
  const double flutes = point.cutter.flutes;
  return cutter::has_runout(point.cutter) ? discs * flutes * flutes : discs;
}

double material_removal_rate(const Case& point) {
  // Width swept at height z is r(z) (cos entry - cos exit) = 2 r(z) immersion.
  return feed_rate(point) * 2.0 * radial_immersion(point) *
         cutter::section_area(cutter::Envelope(point.cutter), point.cut.axial_depth);
}

namespace {

/// Modes that leave more of a response than this do not stand for it.
constexpr double kMostUnexplained = 0.2;

dynamics::Machine listed_modes(const Case& point) {
  dynamics::Machine machine;
  const auto mode_of = [](const auto& given) {
    return dynamics::Mode{core::kTurn * given.frequency.value_or(0.0),
                          given.damping_ratio.value_or(0.0)};
  };
  const auto add = [&](const auto& given, std::vector<dynamics::AxisMode>& axis) {
    for (const AxisModeSection& mode : given) {
      if (!mode.frequency) continue;
      axis.push_back({mode_of(mode), mode.mass.value_or(0.0), mode.stiffness.value_or(0.0)});
    }
  };
  add(point.modes.x, machine.x);
  add(point.modes.y, machine.y);
  for (const CoupledModeSection& mode : point.modes.coupled) {
    if (!mode.frequency || mode.residue.size() != 4) continue;
    const std::vector<double>& r = mode.residue;
    machine.coupled.push_back({mode_of(mode), {r[0], r[1], r[2], r[3]}});
  }
  return machine;
}

}  // namespace

dynamics::Machine machine(const Case& point) {
  dynamics::Machine machine = listed_modes(point);
  const auto add = [](std::string_view axis, const ResponsePtr& response,
                      std::vector<dynamics::AxisMode>& modes) {
    if (!response) return;
    const identify::ModeFit& fit = response->fit;
    if (fit.unexplained > kMostUnexplained) {
      throw core::CaseError(fmt::format(
          "{} modes fitted to modes.response_{}_file leave {:.0f} % of it: it is too noisy, or no "
          "response at one point; method zeroth_order takes it as it is",
          fit.modes.size(), axis, 100.0 * fit.unexplained));
    }
    modes.insert(modes.end(), fit.modes.begin(), fit.modes.end());
  };
  add("x", point.modes.response_x, machine.x);
  add("y", point.modes.response_y, machine.y);
  return machine;
}

dynamics::FrequencyDomain frequency_domain(const Case& point) {
  const auto measured = [](const ResponsePtr& response) {
    return response ? response->measured : nullptr;
  };
  return dynamics::frequency_domain(
      listed_modes(point), {measured(point.modes.response_x), measured(point.modes.response_y)});
}

}  // namespace millstudy::study
