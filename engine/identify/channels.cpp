// SPDX-License-Identifier: MIT
#include "identify/channels.h"

#include <algorithm>

namespace millstudy::identify {

int ChannelSet::line_of(std::size_t sample) const {
  const auto after =
      std::upper_bound(lines.begin(), lines.end(), sample,
                       [](std::size_t s, const Lines& run) { return s < run.begin; });
  if (after == lines.begin()) return 0;
  const Lines& run = *(after - 1);
  return run.line + static_cast<int>(sample - run.begin);
}

const Channel* ChannelSet::find(std::string_view name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const Channel& channel) { return channel.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

}  // namespace millstudy::identify
