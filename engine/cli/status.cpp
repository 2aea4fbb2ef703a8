// SPDX-License-Identifier: MIT
// The verb status: how far a run is, while it runs or after.
#include <algorithm>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/progress.h"
#include "core/error.h"
#include "io/result_reader.h"
#include "sweep/journal.h"

namespace millstudy::cli {
namespace {

constexpr std::size_t kSlowest = 5;

struct SlowBlock {
  std::int64_t first = 0;
  std::int64_t count = 0;
  double seconds = 0.0;
};

struct BlockFigures {
  std::int64_t blocks = 0;
  double median = 0.0;  // [s]
  std::vector<SlowBlock> slowest;
};

BlockFigures figures(const sweep::JournalContents& contents) {
  BlockFigures f;
  std::vector<float> seconds;
  std::vector<SlowBlock> all;
  for (std::size_t i = 0; i < contents.entries.size(); ++i) {
    const sweep::JournalEntry& entry = contents.entries[i];
    if (entry.place == 0) continue;
    const auto index = static_cast<std::int64_t>(i);
    seconds.push_back(entry.seconds);
    all.push_back(
        {contents.header.first_of(index), contents.header.count_of(index), entry.seconds});
    const auto slower = [](const SlowBlock& a, const SlowBlock& b) {
      return a.seconds > b.seconds;
    };
    if (all.size() >= 1024) {
      std::partial_sort(all.begin(), all.begin() + kSlowest, all.end(), slower);
      all.resize(kSlowest);
    }
  }
  f.blocks = static_cast<std::int64_t>(seconds.size());
  if (seconds.empty()) return f;
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  f.median = seconds[seconds.size() / 2];
  std::sort(all.begin(), all.end(),
            [](const SlowBlock& a, const SlowBlock& b) { return a.seconds > b.seconds; });
  all.resize(std::min(all.size(), kSlowest));
  f.slowest = std::move(all);
  return f;
}

int print_running(const std::string& result, const sweep::JournalContents& now, bool running,
                  bool json) {
  const BlockFigures blocks = figures(now);
  const std::int64_t left = now.header.count - now.done();
  const double rate = now.session_seconds > 0.0
                          ? static_cast<double>(now.session_points) / now.session_seconds
                          : 0.0;
  const double seconds_left = rate > 0.0 ? static_cast<double>(left) / rate : -1.0;
  if (json) {
    nlohmann::json slowest = nlohmann::json::array();
    for (const SlowBlock& block : blocks.slowest) {
      slowest.push_back(
          {{"first_point", block.first}, {"points", block.count}, {"seconds", block.seconds}});
    }
    nlohmann::json status = {{"status", running ? "running" : "unfinished"},
                             {"result", result},
                             {"owner", now.owner},
                             {"points", now.header.count},
                             {"ok", now.ok},
                             {"failed", now.failed},
                             {"skipped", now.skipped},
                             {"remaining", left},
                             {"points_per_second", rate},
                             {"seconds", now.seconds},
                             {"sessions", now.sessions},
                             {"blocks", blocks.blocks},
                             {"block_seconds_median", blocks.median},
                             {"slowest_blocks", slowest},
                             {"damaged", now.damaged},
                             {"journal_bytes", now.size},
                             {"study_hash", now.header.study_hash}};
    if (seconds_left >= 0.0) status["seconds_left"] = seconds_left;
    fmt::print("{}\n", status.dump(2));
    return kDone;
  }
  const double part = 100.0 * static_cast<double>(now.done()) /
                      static_cast<double>(std::max<std::int64_t>(1, now.header.count));
  fmt::print("{}: {}\n", result,
             running ? "running, by " + now.owner : "unfinished: the same run goes on with it");
  fmt::print("done:   {} of {} points ({:.1f} %), {} failed, {} skipped\n", count_text(now.done()),
             count_text(now.header.count), part, count_text(now.failed), count_text(now.skipped));
  fmt::print("time:   {} so far{}\n", duration_text(now.seconds),
             now.sessions > 1 ? fmt::format(" in {} sessions", now.sessions) : "");
  if (rate > 0.0) {
    fmt::print("rate:   {} points/s, about {} left\n", count_text(static_cast<std::int64_t>(rate)),
               duration_text(seconds_left));
  }
  if (blocks.blocks > 0) {
    fmt::print("blocks: {}, half of them within {} each; the slowest:\n", count_text(blocks.blocks),
               duration_text(blocks.median));
    for (const SlowBlock& block : blocks.slowest) {
      fmt::print("        {}, points {} to {}\n", duration_text(block.seconds),
                 count_text(block.first), count_text(block.first + block.count - 1));
    }
  }
  if (now.damaged > 0) {
    fmt::print("damaged places in the journal: {}; those blocks are computed again\n", now.damaged);
  }
  return kDone;
}

int print_finished(const std::string& path, const io::ResultSummary& summary, bool json) {
  const std::int64_t ok = summary.integer("points_ok").value_or(0);
  const std::int64_t failed = summary.integer("points_failed").value_or(0);
  const std::int64_t skipped = summary.integer("points_skipped").value_or(0);
  const auto time = summary.attributes.find("wall_time_s");
  const double* seconds =
      time != summary.attributes.end() ? std::get_if<double>(&time->second) : nullptr;
  if (json) {
    const nlohmann::json status = {{"status", "done"},
                                   {"result", path},
                                   {"points", ok + failed + skipped},
                                   {"ok", ok},
                                   {"failed", failed},
                                   {"skipped", skipped},
                                   {"remaining", 0},
                                   {"seconds", seconds ? *seconds : 0.0},
                                   {"study_hash", summary.text("study_hash").value_or("")}};
    fmt::print("{}\n", status.dump(2));
    return kDone;
  }
  fmt::print("{}: done\n", path);
  fmt::print("done:   {} points, {} ok, {} failed, {} skipped\n", count_text(ok + failed + skipped),
             count_text(ok), count_text(failed), count_text(skipped));
  if (seconds) fmt::print("time:   {}\n", duration_text(*seconds));
  return kDone;
}

}  // namespace

int status(const std::string& result, bool json) {
  const std::string path = result + ".journal";
  if (const auto journal = sweep::read_journal(path)) {
    return print_running(result, *journal, sweep::Journal::is_taken(path), json);
  }
  if (const auto summary = io::read_result_summary(result)) {
    if (!summary->text("study_hash")) {
      throw core::InputError({result, 0}, "is no result of a study");
    }
    return print_finished(result, *summary, json);
  }
  throw core::InputError({result, 0}, "there is neither this result nor a journal of it");
}

}  // namespace millstudy::cli
