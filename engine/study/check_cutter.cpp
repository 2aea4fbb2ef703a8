// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include "core/error.h"
#include "study/kind.h"
#include "study/rules.h"

namespace millstudy::study {

void check_cutter_keys(const Given& given, Faults& faults) {
  constexpr std::string_view kRadius = "cutter.corner_centre_radius_mm";
  constexpr std::string_view kHeight = "cutter.corner_centre_height_mm";
  if (!given.may_be("cutter.shape", "general")) return;  // it is not used at all
  if (given.has(kRadius) == given.has(kHeight)) return;
  const auto [there, absent] =
      given.has(kRadius) ? std::pair{kRadius, kHeight} : std::pair{kHeight, kRadius};
  faults.add(given.place({there}), fmt::format("{} [mm] is missing: {} needs it", absent, there));
}

void check_cutter(const Given& given, const Case& base, Faults& faults) {
  const std::vector<BrokenRule> broken = broken_cutter_rules(base);
  add_broken(broken, given, faults);
  if (!broken.empty() || given.section_swept("cutter")) return;
  try {
    cutter::check(base.cutter);
  } catch (const core::InputError& error) {
    for (const core::Fault& fault : error.faults()) {
      faults.add(given.place({"cutter.shape"}), fmt::format("cutter: {}", fault.text));
    }
  }
}

}  // namespace millstudy::study
