// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sweep/runner.h"

namespace millstudy::cli {

/// "1 h 02 min", "3 min 20 s", "4.2 s"
std::string duration_text(double seconds);
/// "1.4 GB"
std::string bytes_text(double bytes);
/// "103,680"
std::string count_text(std::int64_t count);

/// Shows how far a run has come on stderr: a bar that is redrawn on a terminal, a plain line every
/// few seconds elsewhere.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const sweep::Progress& progress);
  /// Takes the bar off the terminal, for what is printed next.
  void clear();

 private:
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  double next_ = 0.0;  // [s] since the start of the run
};

}  // namespace millstudy::cli
