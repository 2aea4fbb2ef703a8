// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>

#include "sweep/journal.h"

namespace millstudy::cli {

/// Appends blocks to a journal. Where the disk is full it tells, waits and tries again.
class JournalSink : public sweep::Sink {
 public:
  /// @param patience  how long it waits for room [s]
  /// @param stop      ends the waiting
  JournalSink(sweep::Journal& journal, double patience, const std::atomic<bool>& stop);

  /// @throws core::ResourceError if there is no room when the time is up
  void write(const sweep::Block& block) override;
  void finish(const std::vector<sweep::Attribute>&) override { journal_.sync(); }

 private:
  sweep::Journal& journal_;
  double patience_;
  const std::atomic<bool>& stop_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::uint32_t session_;
};

}  // namespace millstudy::cli
