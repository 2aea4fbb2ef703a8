// SPDX-License-Identifier: MIT
#include "sweep/shared_run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <fmt/core.h>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/parallel_items.h"

namespace millstudy::sweep {
namespace {

/// Of a process that has nothing to do but wait for messages.
void rest() {
  std::this_thread::sleep_for(std::chrono::microseconds(100));
}

/// A block to compute; where some of its points have a status already, all of it as a frame.
struct Task {
  std::int64_t block = 0;
  std::string frame;
};

std::string encode_tasks(const std::vector<Task>& tasks) {
  std::string bytes;
  const auto put = [&](std::uint64_t number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  for (const Task& task : tasks) {
    put(static_cast<std::uint64_t>(task.block));
    put(task.frame.size());
    bytes += task.frame;
  }
  return bytes;
}

std::vector<Task> decode_tasks(std::string_view bytes) {
  std::vector<Task> tasks;
  const auto get = [&] {
    std::uint64_t number = 0;
    std::memcpy(&number, bytes.data(), sizeof number);
    bytes.remove_prefix(sizeof number);
    return number;
  };
  while (!bytes.empty()) {
    Task task{static_cast<std::int64_t>(get()), {}};
    const std::uint64_t size = get();
    task.frame = bytes.substr(0, size);
    bytes.remove_prefix(size);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

Task task_of(std::int64_t index, const Block& block) {
  const bool fresh = std::all_of(block.status.begin(), block.status.end(),
                                 [](Status status) { return status == Status::not_run; });
  return {index, fresh ? "" : encode_frame(index, block, {})};
}

/// A block that came as a frame from another process of the team.
Block block_of(const JournalHeader& header, std::string_view frame) {
  const auto head = decode_head(frame);
  if (head && is_whole(*head, frame.substr(kFrameHead))) {
    const auto index = static_cast<std::int64_t>(head->block);
    const auto summary = decode_summary(header, index, frame.substr(kFrameHead));
    auto block = decode_block(header, index, frame.substr(kFrameHead));
    if (block && summary) {
      block->seconds = summary->times.seconds;
      return std::move(*block);
    }
  }
  throw std::runtime_error("a block was damaged between two processes");
}

/// The work of one helper: one thread speaks with the lead, the others compute.
class Helper {
 public:
  Helper(Team& team, const JournalHeader& header, const EvaluateBlock& evaluate, int threads,
         std::atomic<bool>& stop)
      : team_(team), header_(header), evaluate_(evaluate), threads_(threads), stop_(stop) {}

  void run() {
    std::thread computing([this] { compute(); });
    bool working = true;
    while (working) {
      const bool busy = read_messages();
      if (stop_) end(true);
      ask();
      bool quiet = false;
      {
        const std::lock_guard lock(mutex_);
        working = computing_;
        quiet = results_.empty();
      }
      send_results();
      if (working && quiet && !busy) rest();
    }
    computing.join();
    send_results();
    if (failure_) std::rethrow_exception(failure_);
    team_.send(0, Note::bye, "");
    while (!dismissed_) {
      if (!read_messages()) rest();
    }
  }

 private:
  void compute() {
    const auto next = [this]() -> std::optional<Task> {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return !tasks_.empty() || no_more_; });
      if (tasks_.empty()) return std::nullopt;
      Task task = std::move(tasks_.front());
      tasks_.pop_front();
      return task;
    };
    const auto compute_one = [this](const Task& task) {
      return std::pair(task.block, computed(evaluate_, begin(task)));
    };
    const auto hand_in = [this](const std::pair<std::int64_t, Block>& result) {
      std::string frame = encode_frame(result.first, result.second, {result.second.seconds});
      const std::lock_guard lock(mutex_);
      results_.push_back(std::move(frame));
      --held_;
    };
    try {
      core::parallel_items(next, threads_, compute_one, hand_in);
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    computing_ = false;
  }

  Block begin(const Task& task) const {
    if (!task.frame.empty()) return block_of(header_, task.frame);
    return {header_.first_of(task.block), header_.count_of(task.block),
            static_cast<std::size_t>(header_.columns), header_.traces};
  }

  /// @return true if there was any
  bool read_messages() {
    bool any = false;
    while (const auto message = team_.receive()) {
      any = true;
      if (message->note == Note::blocks) {
        asked_ = false;
        const std::lock_guard lock(mutex_);
        if (no_more_) continue;  // halted meanwhile
        for (Task& task : decode_tasks(message->bytes)) {
          tasks_.push_back(std::move(task));
          ++held_;
        }
        wake_.notify_all();
      } else if (message->note == Note::no_more) {
        end(false);
      } else if (message->note == Note::halt) {
        stop_ = true;
        end(true);
      } else if (message->note == Note::dismissed) {
        dismissed_ = true;
      }
    }
    return any;
  }

  /// No blocks come any more. @param drop  those that are not begun are left, too
  void end(bool drop) {
    const std::lock_guard lock(mutex_);
    no_more_ = true;
    if (drop) tasks_.clear();
    wake_.notify_all();
  }

  void ask() {
    std::int64_t wanted = 0;
    {
      const std::lock_guard lock(mutex_);
      if (asked_ || no_more_) return;
      wanted = 4 * threads_ - held_;
    }
    if (wanted < 2 * threads_) return;  // it still has some
    team_.send(0, Note::want, encode_tasks({{wanted, {}}}));
    asked_ = true;
  }

  void send_results() {
    std::deque<std::string> results;
    {
      const std::lock_guard lock(mutex_);
      results.swap(results_);
    }
    for (std::string& frame : results) team_.send(0, Note::result, std::move(frame));
  }

  Team& team_;
  const JournalHeader& header_;
  const EvaluateBlock& evaluate_;
  const int threads_;
  std::atomic<bool>& stop_;
  bool asked_ = false;  // and not answered
  bool dismissed_ = false;
  std::exception_ptr failure_;

  std::mutex mutex_;  // of what follows
  std::condition_variable wake_;
  std::deque<Task> tasks_;
  std::deque<std::string> results_;
  std::int64_t held_ = 0;  // blocks that were given and are not in results
  bool no_more_ = false;
  bool computing_ = true;
};

}  // namespace

Lead::~Lead() {
  try {
    for (int i = 1; i < team_.size() && !met_; ++i) next_hello();
    tell_all(Note::dismissed, "");
  } catch (...) {  // nobody is left to be told
  }
}

void Lead::tell_all(Note note, const std::string& bytes) {
  for (int rank = 1; rank < team_.size(); ++rank) team_.send(rank, note, bytes);
}

Message Lead::next_hello() {
  while (true) {
    auto message = team_.receive();
    if (message && message->note == Note::hello) return std::move(*message);
    if (!message) rest();
  }
}

void Lead::meet(const std::string& identity) {
  std::vector<core::Fault> faults;
  for (int i = 1; i < team_.size(); ++i) {
    const Message hello = next_hello();
    const core::Place place{fmt::format("rank {}", hello.from), 0};
    const std::string said = hello.bytes.substr(1);
    if (hello.bytes[0] == '!') {
      faults.push_back({place, said});
    } else if (said != identity) {
      faults.push_back({place, fmt::format("has {}, rank 0 {}", said, identity)});
    }
  }
  met_ = true;
  if (!faults.empty()) throw core::InputError(faults);
}

Progress Lead::run(const EvaluateBlock& evaluate, const JournalHeader& header, Sink& sink,
                   const Remainder& remainder, const RunOptions& options) {
  if (team_.size() == 1) return run_blocks(evaluate, sink, remainder, options);
  BlockDesk desk(remainder, sink, options);
  std::exception_ptr failure;  // the first one
  std::atomic<bool> failed = false;
  const auto guarded = [&](const auto& work) {
    try {
      work();
    } catch (...) {
      if (!failed.exchange(true)) failure = std::current_exception();
      desk.stop();
    }
  };
  tell_all(Note::begin, encode_header(header));
  std::thread own(
      [&] { guarded([&] { compute_blocks(desk, evaluate, remainder, options.threads); }); });
  bool halted = false;
  for (int working = team_.size() - 1; working > 0;) {
    if (desk.stopped() && !halted) {
      tell_all(Note::halt, "");
      halted = true;
    }
    const auto message = team_.receive();
    if (!message) {
      rest();
      continue;
    }
    if (message->note == Note::want) {
      std::vector<Task> tasks;
      const std::int64_t wanted = decode_tasks(message->bytes).at(0).block;
      while (static_cast<std::int64_t>(tasks.size()) < wanted) {
        const auto block = desk.next();
        if (!block) break;
        guarded([&] { tasks.push_back(task_of(*block, remainder.begin(*block))); });
      }
      const Note answer = tasks.empty() ? Note::no_more : Note::blocks;
      team_.send(message->from, answer, encode_tasks(tasks));
    } else if (message->note == Note::result) {
      guarded([&] {
        if (!failed) desk.take(block_of(header, message->bytes));
      });
    } else if (message->note == Note::bye) {
      --working;
    }
  }
  own.join();
  if (failure) std::rethrow_exception(failure);
  return desk.progress();
}

void help(Team& team, const std::string& identity, const EvaluateBlock& evaluate, int threads,
          std::atomic<bool>& stop) {
  team.send(0, Note::hello, '=' + identity);
  while (true) {
    const auto message = team.receive();
    if (!message) {
      rest();
    } else if (message->note == Note::begin) {
      const auto header = decode_header(message->bytes);
      if (!header) throw std::runtime_error("the lead of the team is another program");
      Helper(team, *header, evaluate, threads, stop).run();
      return;
    } else if (message->note == Note::dismissed) {
      return;
    }
  }
}

void excuse(Team& team, const std::string& why) {
  team.send(0, Note::hello, '!' + why);
  while (true) {
    const auto message = team.receive();
    if (message && message->note == Note::dismissed) return;
    if (!message) rest();
  }
}

}  // namespace millstudy::sweep
