// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <span>

#include "study/kind.h"
#include "study/rules.h"

namespace millstudy::study {
namespace {

constexpr std::array<std::string_view, 3> kExponents = {
    "coefficients.Ktc_exponent", "coefficients.Krc_exponent", "coefficients.Kac_exponent"};
constexpr std::array<std::string_view, 6> kTables = {
    "coefficients.Ktc_table", "coefficients.Krc_table", "coefficients.Kac_table",
    "coefficients.Kte_table", "coefficients.Kre_table", "coefficients.Kae_table"};
constexpr std::string_view kReference = "coefficients.reference_chip_thickness_mm";
constexpr std::string_view kHeights = "coefficients.heights_mm";

/// One key and others that are nothing without it, nor it without one of them.
void check_together(std::string_view one, std::span<const std::string_view> others,
                    std::string_view other, const Given& given, Faults& faults) {
  const auto given_one = std::find_if(others.begin(), others.end(),
                                      [&](std::string_view path) { return given.has(path); });
  if (given_one != others.end() && !given.has(one)) {
    faults.add(given.place({*given_one}),
               fmt::format("{} [mm] is missing: {} needs it", one, *given_one));
  } else if (given_one == others.end() && given.has(one)) {
    faults.add(given.place({one}),
               fmt::format("{} is not used without {}: leave it out", one, other));
  }
}

}  // namespace

void check_coefficient_keys(const Given& given, Faults& faults) {
  if (!given.has("coefficients.model") || given.may_be("coefficients.model", "constant")) {
    check_together(kReference, kExponents, "an exponent", given, faults);
  }
  check_together(kHeights, kTables, "a table", given, faults);
}

void check_coefficients(const Given& given, const Case& base, Faults& faults) {
  add_broken(broken_coefficient_rules(base), given, faults);
}

}  // namespace millstudy::study
