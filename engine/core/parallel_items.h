// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace millstudy::core {

/// Number of threads that 0 ("all") means here.
inline int available_threads() {
  return oneapi::tbb::this_task_arena::max_concurrency();
}

/// Calls work() once for each of so many threads, on as many at once as there are.
template <class Work>
void call_on_threads(int threads, const Work& work) {
#ifdef __SANITIZE_THREAD__
  // The sanitizer cannot see how the system's oneTBB hands work over, and would report all of it.
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
#else
  namespace tbb = oneapi::tbb;
  // More threads than cores are nobody's wish but a test's; without this they would be cut down.
  const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        0, threads, 1, [&](int) { work(); }, tbb::simple_partitioner());
  });
#endif
}

/// The only parallel loop of the engine: results are computed on any thread and consumed as soon as
/// they are there, one at a time.
///
/// At most one result a thread is alive at once, however many items there are: memory is bounded by
/// what is in flight. An exception from any function ends the loop and is thrown here.
///
/// @param next     optional<Item> next(), the items one after the other until there are no more;
///                 called by one thread at a time
/// @param threads  >= 1; 0 is all
/// @param compute  Result compute(Item&&), called concurrently
/// @param consume  void consume(Result&&), called by one thread at a time
template <class Next, class Compute, class Consume>
void parallel_items(const Next& next, int threads, const Compute& compute, const Consume& consume) {
  std::mutex next_mutex, consume_mutex;
  std::atomic<bool> failed = false;
  std::exception_ptr failure;  // the first one
  const auto take = [&]() -> decltype(next()) {
    const std::lock_guard lock(next_mutex);
    if (failed) return std::nullopt;
    return next();
  };
  call_on_threads(threads > 0 ? threads : available_threads(), [&] {
    try {
      while (auto item = take()) {
        auto result = compute(std::move(*item));
        const std::lock_guard lock(consume_mutex);
        if (!failed) consume(std::move(result));
      }
    } catch (...) {
      if (!failed.exchange(true)) failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

}  // namespace millstudy::core
