// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace millstudy::io {

/// Numbers the distinct reasons of failed points in order of first appearance; 0 is "none".
///
/// Bounded: after 10 000 distinct reasons, further new ones share the code of "other failures".
class FailureTable {
 public:
  /// @param reason  empty for a point that did not fail
  std::int32_t code(const std::string& reason);
  /// Reason of every code, shape (highest code + 1).
  const std::vector<std::string>& reasons() const { return reasons_; }

 private:
  std::vector<std::string> reasons_ = {"none"};
  std::unordered_map<std::string, std::int32_t> codes_ = {{"", 0}};
};

}  // namespace millstudy::io
