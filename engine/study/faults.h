// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace millstudy::study {

/// Collects every fault of a study before any is reported.
class Faults {
 public:
  void add(core::Place place, std::string text) {
    faults_.push_back({std::move(place), std::move(text)});
  }

  /// Runs step(); what it finds wrong is collected. True if nothing was.
  template <class Step>
  bool collect(const Step& step) {
    try {
      step();
      return true;
    } catch (const core::InputError& error) {
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
      return false;
    }
  }

  bool empty() const { return faults_.empty(); }
  void throw_if_any() const {
    if (!faults_.empty()) throw core::InputError(faults_);
  }

 private:
  std::vector<core::Fault> faults_;
};

}  // namespace millstudy::study
