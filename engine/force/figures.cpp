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
  longest_feed_ = std::max(longest_feed_, feed.per_tooth);
  lowest_slope_ = empty_ ? feed.slope : std::min(lowest_slope_, feed.slope);
  highest_slope_ = empty_ ? feed.slope : std::max(highest_slope_, feed.slope);
  empty_ = false;
  const double sine = largest_sine(sampler.arcs());
  if (sine > widest_sine_) {
    widest_sine_ = sine;
    widest_.assign(sampler.arcs().begin(), sampler.arcs().end());
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
  constexpr int kSlopes = 8;
  for (int i = 0; i <= kSlopes; ++i) {
    if (i > 0 && lowest_slope_ == highest_slope_) break;
    const Feed feed = {longest_feed_, 0.0,
                       lowest_slope_ + (highest_slope_ - lowest_slope_) * i / kSlopes};
    const std::vector<double> found = largest_chip_thickness(sampler_.edges(), widest_, feed);
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
