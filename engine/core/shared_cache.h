// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <iterator>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>

namespace millstudy::core {

/// A bounded memo of expensive values, shared between threads: the same key gives the same value,
/// computed again only if it was dropped meanwhile. What is in the cache never changes a result.
///
/// What it holds is bounded by the sum of the values' costs (1 each unless a cost is given).
/// Two threads that miss the same key at once both compute; neither waits for the other. Where
/// nothing was found for long, as in a sweep that never comes back to a key, threads leave the
/// cache alone but for now and then: it would only hold their memory and make them wait.
template <class T>
class SharedCache {
 public:
  using Cost = std::size_t (*)(const T&);

  explicit SharedCache(
      std::size_t capacity, Cost cost = [](const T&) { return std::size_t{1}; })
      : capacity_(capacity), cost_(cost) {}

  /// The value for the key; make() is called outside the lock on a miss.
  template <class Make>
  std::shared_ptr<const T> get(const std::string& key, const Make& make) {
    if (is_left_alone()) return std::make_shared<const T>(make());
    if (std::shared_ptr<const T> found = find(key)) return found;
    auto made = std::make_shared<const T>(make());
    insert(key, made);
    return made;
  }

  static constexpr int kPatience = 1024;  ///< misses in a row before it is left alone
  /// Two calls one after the other of so many go on to look: an odd number, so that of keys that
  /// come in pairs both are among them.
  static constexpr int kNowAndThen = 65;

 private:
  bool is_left_alone() const {
    if (misses_in_a_row_.load(std::memory_order_relaxed) < kPatience) return false;
    thread_local int times = 0;
    times = (times + 1) % kNowAndThen;
    return times >= 2;
  }

  struct Entry {
    std::string key;
    std::shared_ptr<const T> value;
    std::thread::id maker = std::this_thread::get_id();
  };
  using Entries = std::list<Entry>;

  std::shared_ptr<const T> find(const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto at = index_.find(key);
    if (at == index_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, at->second);
    misses_in_a_row_.store(0, std::memory_order_relaxed);
    return at->second->value;
  }

  void insert(const std::string& key, std::shared_ptr<const T> value) {
    Entries dropped;  // is destroyed after the lock is given back: values can be large
    const std::lock_guard lock(mutex_);
    const int misses = misses_in_a_row_.load(std::memory_order_relaxed);
    if (misses < kPatience) misses_in_a_row_.store(misses + 1, std::memory_order_relaxed);
    if (index_.contains(key)) return;
    held_ += cost_(*value);
    entries_.push_front({key, std::move(value)});
    index_.emplace(key, entries_.begin());
    while (held_ > capacity_) {
      const auto last = oldest();
      held_ -= cost_(*last->value);
      index_.erase(last->key);
      dropped.splice(dropped.begin(), entries_, last);
    }
  }

  /// Of the entries that were not used for the longest time one that this thread made, if there is
  /// one: to give back the memory of another thread is to wait for it. Not the newest, if there is
  /// another.
  typename Entries::iterator oldest() {
    constexpr int kLookedAt = 16;
    auto entry = std::prev(entries_.end());
    for (int i = 0; i < kLookedAt && entry != entries_.begin(); ++i, --entry) {
      if (entry->maker == std::this_thread::get_id()) return entry;
    }
    return std::prev(entries_.end());
  }

  std::size_t capacity_;
  Cost cost_;
  std::size_t held_ = 0;
  std::atomic<int> misses_in_a_row_ = 0;  ///< is written under the lock
  std::mutex mutex_;
  Entries entries_;  // most recently used first
  std::unordered_map<std::string, typename Entries::iterator> index_;
};

}  // namespace millstudy::core
