// SPDX-License-Identifier: MIT
// libFuzzer target of one format, MILLSTUDY_FORMAT: any bytes give a trace or an InputError.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <unistd.h>

#include "core/error.h"
#include "identify/prepare_trace.h"
#include "io/traces/format.h"

namespace {

using namespace millstudy;

/// MATLAB and HDF5 files are opened by name: a file in memory.
std::string write_file(std::string_view bytes) {
  static const std::string path = "/dev/shm/millstudy-fuzz-" + std::to_string(getpid());
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  static const int removed = std::atexit([] { unlink(path.c_str()); });
  static_cast<void>(removed);
  return path;
}

bool needs_file() {
  const io::TraceFormat* const format = &io::MILLSTUDY_FORMAT;
  return format == &io::kMatlab5 || format == &io::kHdf5;
}

void prepare(const io::TraceFile& file) {
  identify::TraceOptions options;
  std::array<std::string, 3> axes;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, file.channels.channels.size()); ++i) {
    axes[i] = (i == 1 ? "-" : "") + file.channels.channels[i].name;
  }
  options.axes = identify::parse_axis_map(axes);
  options.sensitivity_N_per_V = {{"", 100.0}};
  if (file.channels.time.size() % 3 == 1) options.sampling_rate = 1000.0;
  if (file.channels.time.size() % 3 == 2) options.window = identify::TimeWindow{0.0, 0.02};
  identify::prepare_trace(file.channels, options);
}

template <class Call>
void allow_input_errors(const Call& call) {
  try {
    call();
  } catch (const core::InputError& error) {
    if (error.faults().empty() || error.faults().size() > 20) std::abort();
    for (const core::Fault& fault : error.faults()) {
      if (fault.text.empty()) std::abort();
    }
  }
}

void read(const io::Source& source, const io::TraceSelection& selection) {
  allow_input_errors([&] {
    io::TraceFile file = io::MILLSTUDY_FORMAT.read(source, selection);
    for (const identify::Channel& channel : file.channels.channels) {
      if (channel.samples.size() > io::kMostTraceValues) std::abort();
    }
    file.channels.source = source.path;
    prepare(file);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  io::MILLSTUDY_FORMAT.recognise(bytes);
  if (needs_file()) {
    const io::Source source{write_file(bytes), bytes};
    switch (size % 4) {  // each takes a process
      case 0:
        read(source, {.variables = {{"Fx", "Fx"}, {"Fy", "run.Fy"}}});
        break;
      case 1:
        read(source, {.variables = {{"Fx", "data(:,2)"}, {"time", "data[0,:]"}}});
        break;
      case 2:
        read(source, {.point = 1});
        break;
      default:
        allow_input_errors([&] { io::MILLSTUDY_FORMAT.variables(source); });
    }
    return 0;
  }
  const io::Source source{"fuzz", bytes};
  read(source, {});
  read(source, {.variables = {{"Fx", "2"}, {"time", "1"}}});
  read(source, {.range = io::TraceSelection::Range{2, 5}, .segment = 2});
  allow_input_errors([&] { io::MILLSTUDY_FORMAT.variables(source); });
  return 0;
}
