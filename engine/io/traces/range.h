// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "io/trace_file.h"

namespace millstudy::io {

/// Keeps the samples of a range; what is missing at the end is missing afterwards too.
inline void cut_to_range(std::vector<double>& samples,
                         const std::optional<TraceSelection::Range>& range) {
  if (!range) return;
  const auto size = static_cast<std::int64_t>(samples.size());
  const std::int64_t first = std::min(range->first, size);
  const std::int64_t count = std::min(range->count, size - first);
  samples = std::vector<double>(samples.begin() + first, samples.begin() + first + count);
}

/// The start of what a range leaves, by the sampling rate; where there is a time column it says so.
inline void shift_start(identify::ChannelSet& set,
                        const std::optional<TraceSelection::Range>& range) {
  if (range && set.sampling_rate) {
    set.start += static_cast<double>(range->first) / *set.sampling_rate;
  }
}

/// The same for all channels, times and lines of a set.
inline void cut_to_range(identify::ChannelSet& set,
                         const std::optional<TraceSelection::Range>& range) {
  if (!range) return;
  for (identify::Channel& channel : set.channels) cut_to_range(channel.samples, range);
  cut_to_range(set.time, range);
  shift_start(set, range);
  const auto first = static_cast<std::size_t>(range->first);
  std::vector<identify::ChannelSet::Lines> lines;
  if (!set.lines.empty()) lines.push_back({0, set.line_of(first)});
  for (const identify::ChannelSet::Lines& run : set.lines) {
    if (run.begin > first) lines.push_back({run.begin - first, run.line});
  }
  set.lines = std::move(lines);
}

}  // namespace millstudy::io
