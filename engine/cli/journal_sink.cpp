// SPDX-License-Identifier: MIT
#include "cli/journal_sink.h"

#include <algorithm>
#include <fmt/core.h>
#include <thread>

#include "cli/progress.h"
#include "core/resource_error.h"

namespace millstudy::cli {

JournalSink::JournalSink(sweep::Journal& journal, double patience, const std::atomic<bool>& stop)
    : journal_(journal), patience_(patience), stop_(stop), session_(journal.contents().sessions) {}

void JournalSink::write(const sweep::Block& block) {
  const bool any = std::any_of(block.status.begin(), block.status.end(), [](sweep::Status status) {
    return status != sweep::Status::not_run;
  });
  if (!any) return;
  const auto since = [](std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const sweep::BlockTimes times = {block.seconds, since(start_), session_};
  const auto first_try = std::chrono::steady_clock::now();
  for (bool told = false;; told = true) {
    try {
      journal_.append(block, times);
      if (told) fmt::print(stderr, "{}: can be written again\n", journal_.path());
      return;
    } catch (const core::ResourceError& error) {
      if (stop_ || since(first_try) >= patience_) {
        throw core::ResourceError(
            fmt::format("{}; all that was written is kept, and the same command goes on with it",
                        error.what()));
      }
      if (!told) {
        fmt::print(stderr, "{}; waiting up to {} for room, Ctrl-C ends the run\n", error.what(),
                   duration_text(patience_));
      }
    }
    for (int i = 0; i < 10 && !stop_; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
}

}  // namespace millstudy::cli
