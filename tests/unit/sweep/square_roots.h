// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

#include "sweep/runner.h"

/// A study for tests of runs: the square root of the number of every point, one in ten fails.
namespace millstudy::sweep {

inline void square_roots(Block& block) {
  for (std::int64_t i = 0; i < block.count; ++i) {
    if (block.status[i] != Status::not_run) continue;
    const std::int64_t number = block.first + i;
    block.status[i] = number % 10 == 3 ? Status::failed : Status::ok;
    if (block.status[i] == Status::ok) block.value(0, i) = std::sqrt(static_cast<double>(number));
  }
}

/// Nothing of it is done yet.
inline Remainder all_of(std::int64_t points, std::int64_t block_size) {
  Remainder all;
  all.points = points;
  for (std::int64_t i = 0; i * block_size < points; ++i) all.blocks.push_back(i);
  all.begin = [=](std::int64_t block) {
    const std::int64_t first = block * block_size;
    return Block(first, std::min(block_size, points - first), 1, false);
  };
  return all;
}

/// Keeps everything in memory, and checks that no block comes twice.
class MemorySink : public Sink {
 public:
  explicit MemorySink(std::int64_t points)
      : values_(points, std::numeric_limits<double>::quiet_NaN()),
        status_(points, Status::not_run) {}

  void write(const Block& block) override {
    for (std::int64_t i = 0; i < block.count; ++i) {
      EXPECT_EQ(status_.at(block.first + i), Status::not_run);
      status_.at(block.first + i) = block.status[i];
      values_.at(block.first + i) = block.value(0, i);
      written_ += block.status[i] != Status::not_run;
    }
  }
  void finish(const std::vector<Attribute>&) override {}

  bool same_bits(const MemorySink& other) const {
    return status_ == other.status_ && values_.size() == other.values_.size() &&
           std::memcmp(values_.data(), other.values_.data(), sizeof(double) * values_.size()) == 0;
  }
  std::int64_t written() const { return written_; }

 private:
  std::vector<double> values_;
  std::vector<Status> status_;
  std::int64_t written_ = 0;
};

}  // namespace millstudy::sweep
