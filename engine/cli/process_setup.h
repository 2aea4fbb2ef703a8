// SPDX-License-Identifier: MIT
#pragma once

namespace millstudy::cli {

/// Opens what is closed of standard input, output and error (as `2>&-` does): the next file would
/// take its number, and messages would go into the result.
void open_standard_streams();

/// From here on a write beyond the limit on file size (ulimit -f) fails like one on a full disk; it
/// would end the program and leave the temporary file.
void report_full_disk_as_error();

}  // namespace millstudy::cli
