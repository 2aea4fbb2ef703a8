// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millstudy::identify {

/// One signal as a file holds it: no unit converted, no sign turned.
struct Channel {
  std::string name;
  std::string unit;             ///< as written ("N", "mV"); empty: the file says none
  std::vector<double> samples;  ///< in that unit
};

/// What a trace file holds, or the channels of it that were asked for.
struct ChannelSet {
  std::string source;             ///< the file, for messages
  std::vector<Channel> channels;  ///< not the time column
  /// What the header or a waveform property says [Hz]; the time column is not consulted.
  std::optional<double> sampling_rate;
  std::vector<double> time;  ///< time column [s], one for each sample; empty: none
  double start = 0.0;    ///< of the first sample on the file's clock [s], where there is no time
  std::string recorded;  ///< date and time of the measurement as written; often empty
  /// What the user should hear of: "the header says 500001 samples, the file holds 10001".
  std::vector<std::string> remarks;

  /// Samples begin .. next begin - 1 stand on consecutive lines of a text file.
  struct Lines {
    std::size_t begin = 0;
    int line = 0;
  };
  std::vector<Lines> lines;  ///< empty for binary files; by ascending begin

  /// Line of a sample, counted from 1; 0: no text file.
  int line_of(std::size_t sample) const;
  /// nullptr: no channel of that name.
  const Channel* find(std::string_view name) const;
};

}  // namespace millstudy::identify
