// SPDX-License-Identifier: MIT
#include "cli/process_setup.h"

#include <csignal>
#include <fcntl.h>
#include <initializer_list>
#include <unistd.h>

namespace millstudy::cli {

void open_standard_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(fd, F_GETFD) < 0) open("/dev/null", O_RDWR);  // takes the lowest free number
  }
}

void report_full_disk_as_error() {
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace millstudy::cli
