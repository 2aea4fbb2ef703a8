// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace millstudy::identify {

/// A signal without what is above a frequency, (I11): a symmetric filter of finite length (sinc
/// under a Blackman window), so that nothing is delayed. Where it would reach over an end the
/// signal is cut off: the result is shorter by as much at both ends.
///
/// Gain 1 at 0 Hz, one half at the frequency; within 2e-3 of 1 below 0.75 of it and below 2e-3
/// above 1.25 of it (measured).
/// @param frequency, sampling_rate  [Hz]
/// @param step  every how many samples the result is computed, >= 1
/// @return shorter by low_pass_length() - 1, then every step-th; empty where nothing is left
std::vector<double> low_pass(std::span<const double> signal, double frequency, double sampling_rate,
                             std::size_t step = 1);

/// Samples that the filter spans.
std::size_t low_pass_length(double frequency, double sampling_rate);

}  // namespace millstudy::identify
