// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include "core/error.h"
#include "study/kind.h"

namespace millstudy::study {
namespace {

void check_feed_keys(const Given& given, Faults& faults) {
  const bool rate = given.has("cut.feed_rate_mm_per_min");
  const bool tooth = given.has("cut.feed_per_tooth_mm");
  if (rate && tooth) {
    faults.add(given.place({"cut.feed_per_tooth_mm"}),
               "cut.feed_per_tooth_mm contradicts cut.feed_rate_mm_per_min: give one of them");
  } else if (!rate && !tooth) {
    faults.add(given.file,
               "cut.feed_rate_mm_per_min [mm/min] or cut.feed_per_tooth_mm [mm] is missing");
  }
}

}  // namespace

void check_engagement_keys(const Given& given, const Case& base, Faults& faults) {
  const bool entry = given.has("cut.entry_deg");
  const bool exit = given.has("cut.exit_deg");
  const bool radial = given.has("cut.radial_depth_mm");
  if (given.has("cut.milling")) {
    if (entry || exit) {
      faults.add(given.place({"cut.entry_deg", "cut.exit_deg"}),
                 "cut.entry_deg and cut.exit_deg contradict cut.milling: give one or the other");
    }
    if (given.swept("cut.milling")) {
      if (!radial) {
        faults.add(given.place({"cut.milling"}),
                   "cut.radial_depth_mm [mm] is missing: up and down milling need it");
      }
    } else if (!base.cut.milling) {
      return;  // its value is at fault: which keys it takes is not known
    } else if (base.cut.milling == Milling::slot && radial) {
      faults.add(given.place({"cut.radial_depth_mm"}),
                 "cut.radial_depth_mm contradicts cut.milling = \"slot\": leave it out");
    } else if (base.cut.milling != Milling::slot && !radial) {
      faults.add(given.place({"cut.milling"}),
                 "cut.radial_depth_mm [mm] is missing: up and down milling need it");
    }
  } else if (!entry || !exit) {
    faults.add(given.place({"cut.entry_deg", "cut.exit_deg"}),
               "cut.milling is missing: slot, up or down; or both cut.entry_deg and cut.exit_deg");
  } else if (radial) {
    faults.add(given.place({"cut.radial_depth_mm"}),
               "cut.radial_depth_mm contradicts cut.entry_deg and cut.exit_deg: leave it out");
  }
}

void check_cut_keys(const Given& given, const Case& base, Faults& faults) {
  check_feed_keys(given, faults);
  check_engagement_keys(given, base, faults);
}

void check_cut(const Given& given, const Case& base, Faults& faults) {
  const bool profile_is_missing =
      base.cutter.shape == cutter::Shape::profile && !base.cutter.profile;
  if (!profile_is_missing &&
      !given.any_swept({"cut.milling", "cut.radial_depth_mm", "cut.entry_deg", "cut.exit_deg",
                        "cutter.shape", "cutter.diameter_mm", "cutter.helix_deg",
                        "cutter.corner_radius_mm", "cutter.taper_deg", "cutter.tip_angle_deg",
                        "cutter.corner_centre_radius_mm", "cutter.corner_centre_height_mm",
                        "cutter.lead", "cutter.profile_file", "cutter.flute_length_mm",
                        "cutter.stick_out_mm", "cut.axial_depth_mm"})) {
    try {
      engagement(base);
    } catch (const core::CaseError& error) {
      std::string text = error.what();
      if (base.cut.radial_depth > base.cutter.diameter) {
        text += fmt::format(" ({} > {} mm)", *base.cut.radial_depth, base.cutter.diameter);
      }
      faults.add(given.place({"cut.radial_depth_mm", "cut.exit_deg", "cut.axial_depth_mm"}),
                 std::move(text));
    } catch (const core::InputError&) {
      // The cutter is at fault, which check_cutter() tells.
    }
  }
  if (!given.any_swept({"cut.feed_rate_mm_per_min", "cut.feed_per_tooth_mm",
                        "cut.spindle_speed_rpm", "cutter.diameter_mm", "cutter.flutes"})) {
    try {
      check_feed(base);
    } catch (const core::CaseError& error) {
      faults.add(given.place({"cut.feed_per_tooth_mm", "cut.feed_rate_mm_per_min"}),
                 fmt::format("{} ({:.4g} mm)", error.what(), feed_per_tooth(base)));
    }
  }
}

void check_numerics(const Given& given, const Case& base, Faults& faults) {
  if (given.any_swept({"numerics.rule", "numerics.discs", "numerics.angular_steps", "cutter.flutes",
                       "cutter.runout_offset_mm", "cutter.runout_tilt_deg"}))
    return;
  if (disc_samples(base) <= kMostDiscSamples) return;
  faults.add(given.place({"numerics.discs", "numerics.angular_steps"}), kTooManyDiscs);
}

}  // namespace millstudy::study
