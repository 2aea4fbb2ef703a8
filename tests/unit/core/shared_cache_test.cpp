// SPDX-License-Identifier: MIT
#include "core/shared_cache.h"

#include <gtest/gtest.h>
#include <memory>
#include <string>
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

using Cache = SharedCache<std::shared_ptr<int>>;

TEST(SharedCache, KeepsFewWhereNothingComesBack) {
  Cache cache(100'000);
  const auto counted = std::make_shared<int>();
  const auto get = [&](int key) { cache.get(std::to_string(key), [&] { return counted; }); };
  int key = 0;
  while (key < Cache::kPatience) get(key++);
  const long before = counted.use_count();
  EXPECT_EQ(before, Cache::kPatience + 1);
  while (key < Cache::kPatience + 100 * Cache::kNowAndThen) get(key++);
  EXPECT_EQ(counted.use_count(), before + 2 * 100);
}

/// Keys that do not come back for long, and then so many, again and again.
void expect_found_after_all(int keys, int times_in_a_row) {
  Cache cache(1000);
  int made = 0;
  const auto get = [&](int key) {
    const auto value =
        cache.get(std::to_string(key), [&] { return ++made, std::make_shared<int>(key); });
    EXPECT_EQ(**value, key);
  };
  for (int key = 0; key < 2 * Cache::kPatience; ++key) get(-1 - key);
  for (int round = 0; round < 2 * Cache::kNowAndThen; ++round) {
    for (int key = 0; key < keys; ++key) {
      for (int i = 0; i < times_in_a_row; ++i) get(key);
    }
  }
  made = 0;
  for (int key = 0; key < keys; ++key) get(key);
  EXPECT_EQ(made, 0) << keys << " keys, " << times_in_a_row << " times in a row";
}

TEST(SharedCache, IsUsedAgainWhereKeysComeBackAfterAll) {
  for (const int keys : {1, 2, 7, 64, 65, 130, 200}) {
    for (const int times : {1, 2, 3}) expect_found_after_all(keys, times);
  }
}

TEST(SharedCache, IsUsedAgainWhereKeysComeInPairs) {
  Cache cache(10);
  int made = 0;
  for (int key = 0; key < 2 * Cache::kPatience; ++key) {
    cache.get(std::to_string(key), [] { return std::make_shared<int>(); });
  }
  for (int key = 10'000; key < 20'000; ++key) {
    for (int i = 0; i < 2; ++i) {
      cache.get(std::to_string(key), [&] { return ++made, std::make_shared<int>(); });
    }
  }
  EXPECT_LT(made, 10'200);
}

}  // namespace
}  // namespace millstudy::core
