// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
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

}  // namespace millstudy::io
