// SPDX-License-Identifier: MIT
#include "core/shared_cache.h"

#include <gtest/gtest.h>
#include <thread>

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

/// Asks the cache that it is in, which would wait for ever if that destroyed it under its lock.
struct Asks {
  ~Asks() {
    if (cache) cache->get("a", [] { return Asks{}; });
  }
  SharedCache<Asks>* cache = nullptr;
};

TEST(SharedCache, DestroysWhatItDropsOutsideTheLock) {
  SharedCache<Asks> cache(2);
  cache.get("a", [] { return Asks{}; });
  cache.get("b", [&] { return Asks{&cache}; });
  cache.get("a", [] { return Asks{}; });
  cache.get("c", [] { return Asks{}; });  // drops b
  cache.get("d", [] { return Asks{}; });
}

TEST(SharedCache, DropsWhatItsThreadMadeIfThatIsOldToo) {
  SharedCache<int> cache(3);
  const auto get = [&](const char* key) {
    bool made = false;
    cache.get(key, [&] { return made = true, 1; });
    return made;
  };
  std::thread([&] { get("other"); }).join();
  get("own");
  get("third");
  get("fourth");  // drops own, which is not the oldest
  EXPECT_FALSE(get("other"));
  EXPECT_TRUE(get("own"));  // drops third
  std::thread([&] {
    get("x");  // drops fourth: the only old one of this thread would be the newest
    EXPECT_FALSE(get("x"));
  }).join();
  EXPECT_TRUE(get("third"));
}

}  // namespace
}  // namespace millstudy::core
