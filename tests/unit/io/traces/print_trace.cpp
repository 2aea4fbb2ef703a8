// SPDX-License-Identifier: MIT
// print_trace FILE [CHANNEL=VARIABLE | point=N] ...: what the readers make of a file, for
// comparison with others.
#include <cstdio>
#include <exception>
#include <fmt/core.h>
#include <string>

#include "io/trace_file.h"

int main(int argc, char** argv) try {
  using namespace millstudy;
  io::TraceSelection selection;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    if (name == "point") {
      selection.point = std::stoll(word.substr(equals + 1));
    } else {
      selection.variables[name] = word.substr(equals + 1);
    }
  }
  const io::TraceFile file = io::read_trace_file(argv[1], selection);
  const identify::ChannelSet& set = file.channels;
  fmt::print("format {}\nrate {}\n", file.format, set.sampling_rate.value_or(0.0));
  for (const std::string& remark : set.remarks) fmt::print("remark {}\n", remark);
  fmt::print("columns{}", set.time.empty() ? "" : " time");
  for (const identify::Channel& channel : set.channels) {
    fmt::print(" {}[{}]", channel.name, channel.unit);
  }
  fmt::print("\n");
  for (std::size_t i = 0; i < set.channels.at(0).samples.size(); ++i) {
    if (!set.time.empty()) fmt::print("{} ", set.time.at(i));
    for (const identify::Channel& channel : set.channels) fmt::print("{} ", channel.samples.at(i));
    fmt::print("\n");
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
