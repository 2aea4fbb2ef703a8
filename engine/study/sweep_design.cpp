// SPDX-License-Identifier: MIT
#include "study/sweep_design.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <utility>

#include "sweep/sampling.h"

namespace millstudy::study {
namespace {

constexpr std::int64_t kMostSamples = 10'000'000;

std::int64_t whole_number(const core::Value& value, std::string_view name, std::int64_t least,
                          std::int64_t most, Faults& faults) {
  const auto* number = std::get_if<std::int64_t>(&value.data);
  if (number && *number >= least && *number <= most) return *number;
  faults.add(value.place,
             fmt::format("{} must be a whole number from {} to {}", name, least, most));
  return 0;
}

// In the order of sweep::Design.
constexpr std::array<std::string_view, 5> kDesigns = {"grid", "zip", "latin_hypercube", "sobol",
                                                      "saltelli"};

sweep::Design design_named(const core::Value& value, Faults& faults) {
  const auto* at = value.is_string() ? std::find(kDesigns.begin(), kDesigns.end(), value.string())
                                     : kDesigns.end();
  if (at != kDesigns.end()) return static_cast<sweep::Design>(at - kDesigns.begin());
  faults.add(value.place, value.is_string()
                              ? fmt::format("sweep.design = \"{}\" must be one of {}",
                                            value.string(), fmt::join(kDesigns, ", "))
                              : fmt::format("sweep.design must be a string: one of {}",
                                            fmt::join(kDesigns, ", ")));
  return sweep::Design::grid;
}

}  // namespace

std::string_view name_of(sweep::Design design) {
  return kDesigns[static_cast<std::size_t>(design)];
}

bool SweepDesign::is_sampled() const {
  return design != sweep::Design::grid && design != sweep::Design::zip;
}

std::size_t SweepDesign::sobol_dimensions() const {
  if (design == sweep::Design::saltelli) return 2 * axes;
  return design == sweep::Design::sobol ? axes : 0;
}

std::string SweepDesign::how(std::size_t axis) const {
  return fmt::format("{} {} samples, seed {}, dimension {},", name_of(design), samples, seed, axis);
}

std::vector<double> SweepDesign::places(std::size_t axis) const {
  const auto dimension = static_cast<int>(axis);
  const auto number = static_cast<std::uint64_t>(seed);
  if (design == sweep::Design::latin_hypercube) {
    return sweep::latin_hypercube(samples, dimension, number);
  }
  if (design == sweep::Design::sobol) return sweep::sobol(samples, dimension, number);
  return sweep::saltelli(samples, static_cast<int>(axes), dimension, number);
}

SweepDesign read_design(const core::Value& section, std::size_t axes,
                        std::vector<core::Fault>& notes, Faults& faults) {
  SweepDesign read;
  read.axes = axes;
  if (const core::Value* design = section.find("design")) {
    read.design = design_named(*design, faults);
  }
  const core::Value* samples = section.find("samples");
  const core::Value* seed = section.find("seed");
  if (!read.is_sampled()) {
    for (const auto& [value, name] : {std::pair{samples, "samples"}, std::pair{seed, "seed"}}) {
      if (!value) continue;
      faults.add(value->place,
                 fmt::format("sweep.{} is for the designs latin_hypercube, sobol and saltelli: "
                             "leave it out",
                             name));
    }
    return read;
  }
  if (samples) {
    const auto each =
        static_cast<std::int64_t>(read.design == sweep::Design::saltelli ? read.axes + 2 : 1);
    read.samples = whole_number(*samples, "sweep.samples", 1, kMostSamples / each, faults);
  } else {
    faults.add(section.place, "sweep.samples is missing: the number of points to sample");
  }
  constexpr std::int64_t kLargestSeed = std::int64_t{1} << 53;
  if (seed) read.seed = whole_number(*seed, "sweep.seed", 0, kLargestSeed, faults);
  const bool power_of_two = (read.samples & (read.samples - 1)) == 0;
  if (read.design != sweep::Design::latin_hypercube && !power_of_two) {
    notes.push_back(
        {samples->place, fmt::format("sweep.samples = {} is no power of two: a {} design is "
                                     "balanced for those only",
                                     read.samples, name_of(read.design))});
  }
  if (read.sobol_dimensions() > sweep::kSobolDimensions) {
    faults.add(section.place,
               fmt::format("sweep.axes has {} axes: a {} design has {} at most", read.axes,
                           name_of(read.design),
                           read.design == sweep::Design::sobol ? sweep::kSobolDimensions
                                                               : sweep::kSobolDimensions / 2));
    read.design = sweep::Design::latin_hypercube;  // which has any number
  }
  return read;
}

}  // namespace millstudy::study
