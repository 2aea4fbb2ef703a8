// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>

#include "core/error.h"

namespace millstudy::core {

/// The computation of a point was told to stop. No exception of the standard's: it is no failure
/// of the point.
struct Interrupted {};

/// While it lives, keep_watch() on this thread ends a computation that was told to stop or takes
/// too long.
class Watch {
 public:
  /// @param stop     may be null
  /// @param seconds  of wall time; <= 0: no limit
  Watch(const std::atomic<bool>* stop, double seconds) : before_(current_) {
    current_ = this;
    stop_ = stop;
    if (seconds <= 0.0) return;
    limited_ = true;
    end_ = std::chrono::steady_clock::now() +
           std::chrono::duration_cast<std::chrono::steady_clock::duration>(
               std::chrono::duration<double>(seconds));
  }
  ~Watch() { current_ = before_; }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  bool is_late() const { return limited_ && std::chrono::steady_clock::now() > end_; }

 private:
  friend void keep_watch();
  static inline thread_local const Watch* current_ = nullptr;
  const Watch* before_;
  const std::atomic<bool>* stop_ = nullptr;
  bool limited_ = false;
  std::chrono::steady_clock::time_point end_{};
};

inline constexpr const char* kTooLate = "took longer than study.point_time_limit_s";

/// Called by computations between steps of microseconds and more: with a limit it reads the clock.
/// @throws Interrupted; CaseError when the time is over
inline void keep_watch() {
  const Watch* watch = Watch::current_;
  if (!watch) return;
  if (watch->stop_ && watch->stop_->load(std::memory_order_relaxed)) throw Interrupted{};
  if (watch->is_late()) throw CaseError(kTooLate);
}

}  // namespace millstudy::core
