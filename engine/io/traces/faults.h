// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace millstudy::io {

/// What is wrong with a trace file, up to a number that someone would read.
class TraceFaults {
 public:
  static constexpr std::size_t kMost = 20;

  explicit TraceFaults(std::string file) : file_(std::move(file)) {}
  bool full() const { return faults_.size() >= kMost; }
  void add(int line, std::string text) {
    if (!full()) faults_.push_back({{file_, line}, std::move(text)});
  }
  /// @throws core::InputError with what was added, if anything was
  void throw_if_any() const {
    if (!faults_.empty()) throw core::InputError(faults_);
  }

 private:
  std::string file_;
  std::vector<core::Fault> faults_;
};

}  // namespace millstudy::io
