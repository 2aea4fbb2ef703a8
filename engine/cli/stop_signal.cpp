// SPDX-License-Identifier: MIT
#include "cli/stop_signal.h"

#include <csignal>
#include <initializer_list>

namespace millstudy::cli {
namespace {

// A signal handler can reach nothing else; this is the program's only mutable global.
std::atomic<bool> stop = false;

extern "C" void on_signal(int) {
  stop.store(true, std::memory_order_relaxed);
}

}  // namespace

std::atomic<bool>& stop_on_signal() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present = {};
    sigaction(number, nullptr, &present);
    // What is ignored stays ignored: SIGHUP under nohup, SIGINT of a job in the background.
    if (present.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
  return stop;
}

}  // namespace millstudy::cli
