// SPDX-License-Identifier: MIT
#include "cli/process_setup.h"

#include <csignal>
#include <fcntl.h>
#include <initializer_list>
#include <malloc.h>
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

void keep_freed_memory() {
#ifdef M_MMAP_THRESHOLD
  constexpr int kLargestBuffer = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestBuffer);
  mallopt(M_TRIM_THRESHOLD, 2 * kLargestBuffer);
#endif
}

}  // namespace millstudy::cli
