// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "identify/axis_map.h"
#include "identify/channels.h"
#include "identify/trace.h"

namespace millstudy::identify {

/// Part of a record [s] on the clock of its file: from <= t < to.
struct TimeWindow {
  double from = 0.0;
  double to = 0.0;
};

/// How forces in the model's axes come out of the channels of a file.
struct TraceOptions {
  AxisMap axes;
  /// [Hz]; it wins over the file's, with a warning where they differ by more than 0.1 %.
  std::optional<double> sampling_rate = std::nullopt;
  std::optional<TimeWindow> window = std::nullopt;  ///< none: the whole record
  /// Units by channel; it wins over the file's. A unit under "" is for every channel without one.
  std::map<std::string, std::string> units = {};
  /// [N/V] by channel, for channels in V or mV; under "": for every channel without one.
  std::map<std::string, double> sensitivity_N_per_V = {};
};

/// A trace, and what was odd about it in one line each.
struct PreparedTrace {
  Trace trace;
  std::vector<std::string> warnings;
};

/// Fewest samples that prepare_trace takes for a record.
inline constexpr std::size_t kFewestSamples = 16;
/// And most: a fit of more would take hours and say no more.
inline constexpr std::size_t kMostSamples = 10'000'000;

/// Takes the window out of the channels, converts to N, applies the axis map.
///
/// The rate comes from the options, else from the time column, else from the file's header. A time
/// column must be uniform to within its own rounding (see time_axis.h). Warnings: rates that
/// disagree, a channel without a unit (taken as N), constant and clipped channels, and the remarks
/// of the file.
///
/// @throws core::InputError, with up to 20 faults, each naming the file and line or sample: a
///         channel that is not there, unequal lengths, unknown units, volts without a sensitivity,
///         no sampling rate, a window outside of the data, NaN or infinite samples, times that
///         repeat, jump or drift, fewer than kFewestSamples samples,
///         more than kMostSamples
PreparedTrace prepare_trace(const ChannelSet& set, const TraceOptions& options);

}  // namespace millstudy::identify
