// SPDX-License-Identifier: MIT
#include "study/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <functional>
#include <numeric>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::study {
namespace {

using Rules = std::vector<BrokenRule>;

void check_count(std::string_view key, const std::vector<double>& angles, int flutes,
                 Rules& broken) {
  if (angles.empty() || std::ssize(angles) == flutes) return;
  broken.push_back({key,
                    fmt::format("{} must have one angle for each flute", key),
                    fmt::format("{} for {} flutes", angles.size(), flutes),
                    {"cutter.flutes"}});
}

/// Beyond a right angle the resultant force would point away from the shear plane: the formula then
/// gives numbers without meaning, and infinite ones at it.
void check_shear_plane(const Case& point, Rules& broken) {
  const force::OrthogonalData& data = point.law.orthogonal;
  const auto at_rake = [&](const force::OrthogonalQuantity& quantity) {
    return quantity.constant + quantity.per_rake * data.rake_angle;
  };
  const double angle = at_rake(data.shear_angle) + at_rake(data.friction_angle) - data.rake_angle;
  if (angle < 0.5 * core::kPi) return;
  broken.push_back(
      {"coefficients.shear_angle_deg",
       "shear angle plus friction angle less rake must be < 90 deg",
       fmt::format("{:.4g} deg", core::deg_from_rad(angle)),
       {"coefficients.model", "coefficients.friction_angle_deg", "coefficients.rake_deg",
        "coefficients.shear_angle_per_rake", "coefficients.friction_angle_per_rake"}});
}

void throw_first(const Rules& broken) {
  if (!broken.empty()) throw core::CaseError(broken.front().text);
}

}  // namespace

std::vector<BrokenRule> broken_cutter_rules(const Case& point) {
  const cutter::Cutter& cutter = point.cutter;
  Rules broken;
  check_count("cutter.pitch_deg", cutter.pitch_angles, cutter.flutes, broken);
  check_count("cutter.helix_deg", cutter.helix_angles, cutter.flutes, broken);
  const double turn = std::accumulate(cutter.pitch_angles.begin(), cutter.pitch_angles.end(), 0.0);
  constexpr double kRounding = 1e-9;  // full turns have been scaled
  if (!cutter.pitch_angles.empty() && std::abs(turn - core::kTurn) > kRounding) {
    broken.push_back({"cutter.pitch_deg", "cutter.pitch_deg must add up to 360 deg",
                      fmt::format("{:.10g}", core::deg_from_rad(turn))});
  }
  const auto [least, most] =
      std::minmax_element(cutter.helix_angles.begin(), cutter.helix_angles.end());
  if (!cutter.helix_angles.empty() && *least < 0.0 && *most > 0.0) {
    broken.push_back({"cutter.helix_deg", "cutter.helix_deg must be of one hand"});
  }
  if (cutter.shape == cutter::Shape::bull_nose && cutter.corner_radius > cutter::radius(cutter)) {
    broken.push_back({"cutter.corner_radius_mm",
                      "cutter.corner_radius_mm must be <= half of cutter.diameter_mm",
                      fmt::format("{} > {} mm", cutter.corner_radius, cutter::radius(cutter)),
                      {"cutter.shape", "cutter.diameter_mm"}});
  }
  if (cutter.runout.offset > cutter::radius(cutter)) {
    broken.push_back({"cutter.runout_offset_mm",
                      "cutter.runout_offset_mm must be <= half of cutter.diameter_mm",
                      fmt::format("{} > {} mm", cutter.runout.offset, cutter::radius(cutter)),
                      {"cutter.diameter_mm"}});
  }
  return broken;
}

std::vector<BrokenRule> broken_coefficient_rules(const Case& point) {
  const force::HeightFactors& height = point.law.height;
  Rules broken;
  if (std::adjacent_find(height.heights.begin(), height.heights.end(), std::greater_equal<>()) !=
      height.heights.end()) {
    broken.push_back({"coefficients.heights_mm", "coefficients.heights_mm must ascend"});
  }
  constexpr std::array<std::string_view, 6> kTables = {
      "coefficients.Ktc_table", "coefficients.Krc_table", "coefficients.Kac_table",
      "coefficients.Kte_table", "coefficients.Kre_table", "coefficients.Kae_table"};
  for (std::size_t i = 0; i < kTables.size(); ++i) {
    if (height.table[i].empty() || height.table[i].size() == height.heights.size()) continue;
    broken.push_back(
        {kTables[i],
         fmt::format("{} must have one factor for each of coefficients.heights_mm", kTables[i]),
         fmt::format("{} for {} heights", height.table[i].size(), height.heights.size()),
         {"coefficients.heights_mm"}});
  }
  if (point.law.model == CoefficientModel::orthogonal) check_shear_plane(point, broken);
  for (const auto& [key, range] :
       {std::pair{"coefficients.valid_feed_per_tooth_mm", &point.valid.feed_per_tooth},
        {"coefficients.valid_cutting_speed_m_per_min", &point.valid.cutting_speed},
        {"coefficients.valid_axial_depth_mm", &point.valid.axial_depth}}) {
    if (std::is_sorted(range->begin(), range->end())) continue;
    broken.push_back({key, fmt::format("{} must ascend", key)});
  }
  return broken;
}

void add_broken(const std::vector<BrokenRule>& broken, const Given& given, Faults& faults) {
  for (const BrokenRule& rule : broken) {
    const bool swept = given.swept(rule.key) ||
                       std::any_of(rule.others.begin(), rule.others.end(),
                                   [&](std::string_view other) { return given.swept(other); });
    if (swept) continue;
    faults.add(given.place({rule.key}),
               rule.detail.empty() ? rule.text : fmt::format("{} ({})", rule.text, rule.detail));
  }
}

void check_point_cutter(const Case& point) {
  throw_first(broken_cutter_rules(point));
  try {
    cutter::check(point.cutter);
  } catch (const core::InputError& error) {
    throw core::CaseError(fmt::format("cutter: {}", error.what()));
  }
}

void check_point_coefficients(const Case& point) {
  throw_first(broken_coefficient_rules(point));
}

}  // namespace millstudy::study
