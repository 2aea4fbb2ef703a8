// SPDX-License-Identifier: MIT
#include "cli/stop_signal.h"

#include <csignal>

namespace millstudy::cli {
namespace {

// A signal handler can reach nothing else; this is the program's only mutable global.
std::atomic<bool> stop = false;

extern "C" void on_signal(int) {
  stop.store(true, std::memory_order_relaxed);
}

}  // namespace

const std::atomic<bool>& stop_on_signal() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return stop;
}

}  // namespace millstudy::cli
