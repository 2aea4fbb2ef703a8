// SPDX-License-Identifier: MIT
#include "cli/progress.h"

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <unistd.h>

namespace millstudy::cli {

std::string duration_text(double seconds) {
  if (seconds < 0.0995) return fmt::format("{:.0f} ms", 1e3 * seconds);
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string bytes_text(double bytes) {
  for (const char* const unit : {"B", "kB", "MB", "GB", "TB"}) {
    if (bytes < 999.5) return fmt::format("{:.{}f} {}", bytes, bytes < 9.95 ? 1 : 0, unit);
    bytes /= 1e3;
  }
  return fmt::format("{:.1f} PB", bytes);
}

std::string count_text(std::int64_t count) {
  std::string digits = std::to_string(count);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), ",");
  }
  return digits;
}

ProgressDisplay::ProgressDisplay(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), next_(terminal_ ? 0.5 : 2.0) {}

ProgressDisplay::~ProgressDisplay() {
  clear();
}

void ProgressDisplay::clear() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

void ProgressDisplay::show(const sweep::Progress& progress) {
  constexpr double kRedraw = 0.2;    // [s] on a terminal
  constexpr double kNextLine = 5.0;  // [s] elsewhere
  if (quiet_ || progress.seconds < next_) return;
  next_ = progress.seconds + (terminal_ ? kRedraw : kNextLine);
  const double part = static_cast<double>(progress.done()) / static_cast<double>(progress.points);
  const double rate = static_cast<double>(progress.done() - progress.before) / progress.seconds;
  const double left = static_cast<double>(progress.points - progress.done()) / rate;
  const std::string failed =
      progress.failed > 0 ? fmt::format(", {} failed", count_text(progress.failed)) : "";
  const std::string text =
      fmt::format("{} of {} points{}, {} points/s, {} left", count_text(progress.done()),
                  count_text(progress.points), failed, count_text(static_cast<std::int64_t>(rate)),
                  duration_text(left));
  if (terminal_) {
    constexpr int kWidth = 24;
    const int full = static_cast<int>(part * kWidth);
    const std::string bar = std::string(full, '#') + std::string(kWidth - full, '.');
    fmt::print(stderr, "\r\033[K[{}] {:3.0f} %  {}", bar, 100.0 * part, text);
    drawn_ = true;
  } else {
    fmt::print(stderr, "{:3.0f} %  {}\n", 100.0 * part, text);
  }
  std::fflush(stderr);
}

}  // namespace millstudy::cli
