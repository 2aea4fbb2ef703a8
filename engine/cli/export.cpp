// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "cli/commands.h"
#include "io/table_export.h"

namespace millstudy::cli {

int export_result(const ExportOptions& options) {
  io::export_table(options.result, options.output);
  fmt::print("{}\n", options.output);
  return kDone;
}

}  // namespace millstudy::cli
