// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <utility>

namespace millstudy::core {

/// Number of threads that 0 ("all") means here.
inline int available_threads() {
  return oneapi::tbb::this_task_arena::max_concurrency();
}

/// When results are consumed: in the order of the items, or as soon as they are there.
enum class Order { of_items, of_results };

/// The only parallel loop of the engine: results are computed in any order on any thread and
/// consumed one at a time, in order unless told otherwise. So what consume sees does not depend on
/// the number of threads.
///
/// At most 4 results a thread are alive at once, whatever the count: memory is bounded by what is
/// in flight. An exception from either function ends the loop and is thrown here.
///
/// @param count    items 0 .. count - 1
/// @param threads  >= 1; 0 is all
/// @param stop     set from anywhere: no further item is started, those in flight are consumed
/// @param compute  Result compute(int64 i), called concurrently
/// @param consume  void consume(int64 i, Result&&), called for i = 0, 1, 2, ...
/// @param order    of consume; of_results holds nothing back behind a slow item
/// @return number of items consumed
template <class Compute, class Consume>
std::int64_t ordered_parallel(std::int64_t count, int threads, const std::atomic<bool>& stop,
                              const Compute& compute, const Consume& consume,
                              Order order = Order::of_items) {
  namespace tbb = oneapi::tbb;
  using Result = decltype(compute(std::int64_t{}));
  using Item = std::pair<std::int64_t, Result>;
  if (threads <= 0) threads = available_threads();
  std::int64_t started = 0;
  std::int64_t consumed = 0;
  const auto next = [&](tbb::flow_control& control) -> std::int64_t {
    if (started >= count || stop.load(std::memory_order_relaxed)) {
      control.stop();
      return 0;
    }
    return started++;
  };
  const auto run = [&](std::int64_t i) -> Item { return {i, compute(i)}; };
  const auto finish = [&](Item item) {
    consume(item.first, std::move(item.second));
    ++consumed;
  };
  // More threads than cores are nobody's wish but a test's; without this they would be cut down.
  const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_pipeline(
        4 * static_cast<std::size_t>(threads),
        tbb::make_filter<void, std::int64_t>(tbb::filter_mode::serial_in_order, next) &
            tbb::make_filter<std::int64_t, Item>(tbb::filter_mode::parallel, run) &
            tbb::make_filter<Item, void>(order == Order::of_items
                                             ? tbb::filter_mode::serial_in_order
                                             : tbb::filter_mode::serial_out_of_order,
                                         finish));
  });
  return consumed;
}

}  // namespace millstudy::core
