// SPDX-License-Identifier: MIT
#include "io/failure_table.h"

namespace millstudy::io {
namespace {

constexpr std::size_t kMostReasons = 10000;

}  // namespace

std::int32_t FailureTable::code(const std::string& reason) {
  if (const auto known = codes_.find(reason); known != codes_.end()) return known->second;
  if (reasons_.size() <= kMostReasons) {
    reasons_.push_back(reason);
    codes_.emplace(reason, static_cast<std::int32_t>(reasons_.size() - 1));
  } else if (reasons_.size() == kMostReasons + 1) {
    reasons_.emplace_back("other failures");
  }
  return static_cast<std::int32_t>(reasons_.size() - 1);
}

}  // namespace millstudy::io
