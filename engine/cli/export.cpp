// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include "cli/commands.h"
#include "core/error.h"
#include "io/table_export.h"
#include "io/text_file.h"
#include "io/trace_file.h"

namespace millstudy::cli {
namespace {

/// The trace of one point as a table that every trace reader takes: time and forces on the tool.
void export_trace(const ExportOptions& options) {
  if (!options.output.ends_with(".csv")) {
    throw core::InputError({options.output, 0}, "a trace is written as .csv");
  }
  io::TraceSelection selection;
  selection.point = options.point;
  selection.variables = {{"time", "trace_time"},
                         {"Fx", "trace_force_x"},
                         {"Fy", "trace_force_y"},
                         {"Fz", "trace_force_z"}};
  const identify::ChannelSet set = io::read_trace_file(options.result, selection).channels;
  std::string text = "Time,Fx,Fy,Fz\ns,N,N,N\n";
  const auto& fx = set.find("Fx")->samples;
  const auto& fy = set.find("Fy")->samples;
  const auto& fz = set.find("Fz")->samples;
  for (std::size_t i = 0; i < set.time.size(); ++i) {
    // Traces are single precision: seven digits.
    text += fmt::format("{:.7g},{:.6g},{:.6g},{:.6g}\n", set.time[i], fx[i], fy[i], fz[i]);
  }
  io::write_text_file(options.output, text);
}

}  // namespace

int export_result(const ExportOptions& options) {
  if (options.point >= 0) {
    export_trace(options);
  } else {
    io::export_table(options.result, options.output);
  }
  fmt::print("{}\n", options.output);
  return kDone;
}

}  // namespace millstudy::cli
