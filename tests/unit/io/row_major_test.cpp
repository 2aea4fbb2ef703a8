// SPDX-License-Identifier: MIT
#include "io/row_major.h"

#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace millstudy::io {
namespace {

/// Row-major numbers of the elements of a box, in row-major order.
std::vector<std::int64_t> elements(const Shape& shape, const Box& box) {
  std::vector<std::int64_t> numbers = {0};
  for (std::size_t d = 0; d < shape.size(); ++d) {
    std::vector<std::int64_t> longer;
    for (const std::int64_t number : numbers) {
      for (std::int64_t i = 0; i < box.count[d]; ++i) {
        longer.push_back(number * shape[d] + box.start[d] + i);
      }
    }
    numbers = longer;
  }
  return numbers;
}

Shape random_shape(std::mt19937& random) {
  Shape shape(std::uniform_int_distribution<std::size_t>(0, 5)(random));
  for (std::int64_t& length : shape) {
    length = std::uniform_int_distribution<std::int64_t>(1, 6)(random);
  }
  return shape;
}

TEST(RowMajorBoxes, AreTheRangeInItsOrderAndFew) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 5000; ++trial) {
    const Shape shape = random_shape(random);
    const std::int64_t total = element_count(shape);
    const std::int64_t begin = std::uniform_int_distribution<std::int64_t>(0, total)(random);
    const std::int64_t end = std::uniform_int_distribution<std::int64_t>(begin, total)(random);
    const std::vector<Box> boxes = row_major_boxes(shape, begin, end);
    EXPECT_LE(boxes.size(), shape.empty() ? 1 : 2 * shape.size() - 1);
    std::int64_t next = begin;
    for (const Box& box : boxes) {
      for (const std::int64_t number : elements(shape, box)) ASSERT_EQ(number, next++);
    }
    ASSERT_EQ(next, end);
  }
}

TEST(RowMajorChunk, IsOneRunOfTheOrderAndNotTooLarge) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const Shape shape = random_shape(random);
    const std::int64_t largest = std::uniform_int_distribution<std::int64_t>(1, 50)(random);
    const Shape chunk = row_major_chunk(shape, largest);
    EXPECT_LE(element_count(chunk), largest);
    if (element_count(shape) > largest) {
      EXPECT_GT(2 * element_count(chunk), largest / 2);
    }
    for (std::int64_t begin = 0; begin < element_count(shape);) {
      const std::int64_t end = chunk_around(shape, chunk, begin).end;
      const std::vector<Box> boxes = row_major_boxes(shape, begin, end);
      ASSERT_EQ(boxes.size(), 1u);
      for (std::size_t d = 0; d < shape.size(); ++d) {
        EXPECT_EQ(boxes[0].start[d] % chunk[d], 0);
        EXPECT_EQ(boxes[0].count[d], std::min(chunk[d], shape[d] - boxes[0].start[d]));
      }
      for (std::int64_t element = begin; element < end; ++element) {
        EXPECT_EQ(chunk_around(shape, chunk, element).begin, begin);
        EXPECT_EQ(chunk_around(shape, chunk, element).end, end);
      }
      begin = end;
    }
  }
}

TEST(RowMajorChunk, EndsWithoutOverflow) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(chunk_around(Shape{kMost}, Shape{65536}, kMost - 10).end, kMost);
}

TEST(RowMajorChunk, IsToldFromOthers) {
  std::mt19937 random(3);
  int runs = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const Shape shape = random_shape(random);
    Shape chunk;
    for (const std::int64_t length : shape) {
      chunk.push_back(std::uniform_int_distribution<std::int64_t>(1, length)(random));
    }
    // One run of the order: from its first element to its last there is no other.
    const std::vector<std::int64_t> inside = elements(shape, {Shape(shape.size(), 0), chunk});
    const bool is_run = inside.back() - inside.front() + 1 == element_count(chunk);
    runs += is_run;
    EXPECT_EQ(is_row_major(shape, chunk), is_run);
    EXPECT_TRUE(is_row_major(shape, row_major_chunk(shape, 1 + trial % 50)));
  }
  EXPECT_GT(runs, 1000);
  EXPECT_FALSE(is_row_major(Shape{4, 5}, Shape{5}));
  EXPECT_FALSE(is_row_major(Shape{4}, Shape{5}));
  EXPECT_FALSE(is_row_major(Shape{4}, Shape{0}));
}

}  // namespace
}  // namespace millstudy::io
