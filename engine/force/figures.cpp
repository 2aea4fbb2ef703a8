// SPDX-License-Identifier: MIT
#include "force/figures.h"

#include <algorithm>
#include <cmath>

#include "force/chip_thickness.h"

namespace millstudy::force {

FigureAccumulator::FigureAccumulator(const FigureRequest& request, const ForceSampler& sampler)
    : request_(request), sampler_(sampler) {
  const int flutes = sampler.edges().cutter().flutes;
  if (request.harmonics > 0) spectrum_.emplace(request.harmonics, flutes, sampler.angular_steps());
  if (request.flutes) flute_torque_.assign(flutes, 0.0);
}

void FigureAccumulator::add(const ForceSampler& sampler, const Coefficients& coefficients,
                            const Feed& feed, std::int64_t first, std::int64_t count,
                            const ForceSamples& samples) {
  statistics_.add(samples, count);
  if (spectrum_) spectrum_->add(samples, first, count);
  if (request_.stick_out) add_bending(sampler, coefficients, feed, first, count, samples);
  if (request_.flutes) add_flutes(sampler, coefficients, feed, first, count);
  note_advance({feed.in_plane() * largest_sine(sampler.arcs()), feed.upward()});
}

void FigureAccumulator::note_advance(const Advance& advance) {
  const auto covers = [](const Advance& a, const Advance& b) {
    return a.radial >= b.radial && a.upward <= b.upward;
  };
  for (const Advance& other : advances_) {
    if (covers(other, advance)) return;
  }
  std::erase_if(advances_, [&](const Advance& other) { return covers(advance, other); });
  constexpr std::size_t kMost = 64;  // of a path whose slope changes all along
  if (advances_.size() < kMost) {
    advances_.push_back(advance);
  } else {  // the next best bound: one that covers both
    advances_.back() = {std::max(advances_.back().radial, advance.radial),
                        std::min(advances_.back().upward, advance.upward)};
  }
}

void FigureAccumulator::add_bending(const ForceSampler& sampler, const Coefficients& coefficients,
                                    const Feed& feed, std::int64_t first, std::int64_t count,
                                    const ForceSamples& samples) {
  // (F20): the moment about the holder is that about the tip and the force at the stick-out.
  sampler.sample_moments(coefficients, feed, first, count, buffer_);
  for (std::int64_t i = 0; i < count; ++i) {
    const double x = buffer_.x[i] + *request_.stick_out * samples.y[i];
    const double y = buffer_.y[i] - *request_.stick_out * samples.x[i];
    bending_square_ = std::max(bending_square_, x * x + y * y);
  }
}

void FigureAccumulator::add_flutes(const ForceSampler& sampler, const Coefficients& coefficients,
                                   const Feed& feed, std::int64_t first, std::int64_t count) {
  for (std::size_t j = 0; j < flute_torque_.size(); ++j) {
    sampler.sample_flute(static_cast<int>(j), coefficients, feed, first, count, buffer_);
    double sum = 0.0;
    for (std::int64_t i = 0; i < count; ++i) sum += buffer_.torque[i];
    flute_torque_[j] += sum;
  }
}

ForceFigures FigureAccumulator::result() const {
  ForceFigures figures;
  figures.statistics = statistics_.result();
  figures.bending_moment_max = std::sqrt(bending_square_);
  if (spectrum_) figures.harmonics = spectrum_->amplitudes();
  std::vector<double> thickest(sampler_.edges().flutes().size(), 0.0);
  for (const Advance& advance : advances_) {
    const Feed feed = {std::hypot(advance.radial, advance.upward), 0.0,
                       std::atan2(advance.upward, advance.radial)};
    const std::vector<double> found = largest_chip_thickness(sampler_.edges(), 1.0, feed);
    for (std::size_t j = 0; j < found.size(); ++j) thickest[j] = std::max(thickest[j], found[j]);
  }
  figures.chip_thickness_max = *std::max_element(thickest.begin(), thickest.end());
  double torque = 0.0;
  for (const double sum : flute_torque_) torque += sum;
  for (std::size_t j = 0; j < flute_torque_.size(); ++j) {
    figures.flutes.push_back({thickest[j], torque == 0.0 ? 0.0 : flute_torque_[j] / torque});
  }
  return figures;
}

}  // namespace millstudy::force
