// SPDX-License-Identifier: MIT
#include "core/shared_cache.h"

#include <gtest/gtest.h>

namespace millstudy::core {
namespace {

TEST(SharedCache, ComputesOnceAndDropsTheLeastRecentlyUsed) {
  SharedCache<int> cache(2);
  int made = 0;
  const auto make = [&] { return ++made; };
  EXPECT_EQ(*cache.get("a", make), 1);
  EXPECT_EQ(*cache.get("b", make), 2);
  EXPECT_EQ(*cache.get("a", make), 1);
  EXPECT_EQ(*cache.get("c", make), 3);  // drops b
  EXPECT_EQ(*cache.get("a", make), 1);
  EXPECT_EQ(*cache.get("b", make), 4);
}

TEST(SharedCache, KeepsAValueAliveForItsUserAfterDroppingIt) {
  SharedCache<int> cache(1);
  const auto held = cache.get("a", [] { return 7; });
  cache.get("b", [] { return 8; });
  EXPECT_EQ(*held, 7);
}

TEST(SharedCache, HoldsNoMoreThanItsCapacity) {
  SharedCache<int> cache(10, [](const int& value) { return static_cast<std::size_t>(value); });
  cache.get("six", [] { return 6; });
  cache.get("five", [] { return 5; });  // drops six
  int made = 0;
  cache.get("five", [&] { return ++made; });
  EXPECT_EQ(made, 0);
  EXPECT_EQ(*cache.get("twelve", [] { return 12; }), 12);  // too much to be kept at all
  EXPECT_EQ(*cache.get("twelve", [] { return 13; }), 13);
}

}  // namespace
}  // namespace millstudy::core
