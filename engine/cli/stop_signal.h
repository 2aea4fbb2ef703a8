// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace millstudy::cli {

/// From here on Ctrl-C (SIGINT), SIGTERM and SIGHUP set the flag once; a second one ends the
/// program at once, as it would without us.
std::atomic<bool>& stop_on_signal();

}  // namespace millstudy::cli
