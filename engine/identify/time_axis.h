// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identify/channels.h"

namespace millstudy::identify {

/// Times of evenly spaced samples: sample i at start + i / sampling_rate.
struct TimeAxis {
  double start = 0.0;          ///< [s]
  double sampling_rate = 0.0;  ///< [Hz]
};

/// Fits an even axis to a time column, whose numbers may be rounded: printed with few digits, or
/// kept as 32-bit floats. The rounding is taken from the numbers themselves, per power of ten.
///
/// Every step must be the mean one to within the rounding and 5 % of a step, and no time may be
/// further from the axis than the rounding and half a step. The rate is (n - 1) / duration, taken
/// to the nearest number of six digits where the rounding allows for it.
///
/// @throws core::InputError naming the line or sample where a time repeats, goes back, leaves a
///         gap, drifts or is no number
TimeAxis fit_time_axis(const ChannelSet& set, std::optional<double> expected_rate = {});

/// The axis of a channel set: from the given rate, else the time column, else the header. Warnings
/// are added where two of them differ by more than 0.1 %.
///
/// @throws core::InputError where none says the rate, or as fit_time_axis()
TimeAxis find_time_axis(const ChannelSet& set, std::optional<double> given_rate,
                        std::vector<std::string>& warnings);

/// "line 21" of a text file, "sample 0" of others.
std::string place_of(const ChannelSet& set, std::size_t sample);

}  // namespace millstudy::identify
