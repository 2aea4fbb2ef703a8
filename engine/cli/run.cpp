// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/extension.h"
#include "cli/join_team.h"
#include "cli/journal_sink.h"
#include "cli/open_study.h"
#include "cli/pace.h"
#include "cli/progress.h"
#include "cli/provenance.h"
#include "cli/run_journal.h"
#include "cli/stop_signal.h"
#include "cli/team_run.h"
#include "cli/version.h"
#include "core/error.h"
#include "core/parallel_items.h"
#include "io/atomic_file.h"
#include "io/result_reader.h"
#include "io/result_writer.h"
#include "sweep/shared_run.h"

namespace millstudy::cli {
namespace {

namespace fs = std::filesystem;

/// Passes blocks on and counts why points failed.
class FailureTally : public sweep::Sink {
 public:
  explicit FailureTally(sweep::Sink& sink) : sink_(sink) {}

  void write(const sweep::Block& block) override {
    constexpr std::size_t kMostReasons = 1000;
    for (const std::string& reason : block.failures) {
      if (reason.empty()) continue;
      const bool room = counts_.size() < kMostReasons || counts_.contains(reason);
      ++counts_[room ? reason : "other reasons"];
    }
    sink_.write(block);
  }
  void leave_out(std::int64_t first, std::int64_t count) override { sink_.leave_out(first, count); }
  void finish(const std::vector<sweep::Attribute>& attributes) override {
    sink_.finish(attributes);
  }
  const std::map<std::string, std::int64_t>& counts() const { return counts_; }

 private:
  sweep::Sink& sink_;
  std::map<std::string, std::int64_t> counts_;
};

struct Outcome {
  std::string status;  ///< done, or already done
  std::string result;
  std::int64_t ok = 0;
  std::int64_t failed = 0;
  std::int64_t skipped = 0;
  double seconds = 0.0;
  std::int64_t threads = 0;
  std::string hash;
  std::string computed;  ///< of a result that was there: by which program, and when
};

int print_outcome(const Outcome& outcome, const StudyOptions& options,
                  const std::map<std::string, std::int64_t>& failures) {
  const std::int64_t points = outcome.ok + outcome.failed + outcome.skipped;
  if (options.json) {
    const nlohmann::json json = {
        {"status", outcome.status},   {"result", outcome.result},   {"points", points},
        {"ok", outcome.ok},           {"failed", outcome.failed},   {"skipped", outcome.skipped},
        {"seconds", outcome.seconds}, {"threads", outcome.threads}, {"study_hash", outcome.hash},
    };
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}: {} points, {} ok, {} failed, {} skipped\n", outcome.status, count_text(points),
               count_text(outcome.ok), count_text(outcome.failed), count_text(outcome.skipped));
    for (const auto& [reason, count] : failures) {
      fmt::print("  {} failed: {}\n", count_text(count), reason);
    }
    if (points > 0 && outcome.skipped == points) {
      fmt::print("  every point is outside the limits of sweep.where\n");
    }
    if (!outcome.computed.empty()) fmt::print("{}\n", outcome.computed);
    const double rate = static_cast<double>(points) / std::max(outcome.seconds, 1e-6);
    fmt::print("time:   {} on {} thread{}, {} points/s\n", duration_text(outcome.seconds),
               outcome.threads, outcome.threads == 1 ? "" : "s",
               count_text(static_cast<std::int64_t>(rate)));
    std::error_code error;
    const auto bytes = static_cast<double>(fs::file_size(outcome.result, error));
    fmt::print("result: {} ({})\n", outcome.result, bytes_text(error ? 0.0 : bytes));
  }
  return outcome.failed > 0 ? kPointsFailed : kDone;
}

bool is_of_another_study(const std::string& path, const OpenStudy& open) {
  const std::optional<io::ResultSummary> summary = io::read_result_summary(path);
  return summary && summary->text("study_hash") != open.hash;
}

/// A finished result of this study, if the file is one.
/// @throws core::InputError if it is anything else
std::optional<Outcome> finished_result(const std::string& path, const OpenStudy& open,
                                       const std::string& shard) {
  const std::optional<io::ResultSummary> summary = io::read_result_summary(path);
  if (!summary) return std::nullopt;
  if (summary->text("study_hash") != open.hash) {
    throw core::InputError(
        {path, 0},
        "holds the result of another study; use --fresh to compute this one (the old result is "
        "moved aside), --extend if only values of axes differ, or -o for another file");
  }
  const std::string part = summary->text("shard").value_or("");
  if (part != shard) {
    throw core::InputError(
        {path, 0},
        fmt::format("holds {} of this study, not {}; use --fresh, or -o for another file",
                    part.empty() ? "all" : "part " + part,
                    shard.empty() ? "all" : "part " + shard));
  }
  Outcome outcome{"already done", path, 0, 0, 0, 0.0, 0, open.hash, ""};
  outcome.ok = summary->integer("points_ok").value_or(0);
  outcome.failed = summary->integer("points_failed").value_or(0);
  outcome.skipped = summary->integer("points_skipped").value_or(0);
  outcome.threads = summary->integer("threads").value_or(0);
  const auto time = summary->attributes.find("wall_time_s");
  if (time != summary->attributes.end() && std::holds_alternative<double>(time->second)) {
    outcome.seconds = std::get<double>(time->second);
  }
  const Build made = build();
  const std::string revision = summary->text("git_revision").value_or("unknown");
  outcome.computed = fmt::format(
      "computed by millstudy {} ({}) on {}{}", summary->text("millstudy_version").value_or("?"),
      revision, summary->text("created").value_or("?"),
      revision == made.git_revision
          ? ""
          : "; this program is " + made.git_revision + ", --fresh computes again");
  return outcome;
}

/// Makes room for a fresh result: slot.h5 becomes slot.previous-1.h5, or the next free number.
void move_aside(const fs::path& path, std::string_view what) {
  if (!fs::exists(path)) return;
  for (int number = 1;; ++number) {
    fs::path aside = path;
    aside.replace_filename(
        fmt::format("{}.previous-{}{}", path.stem().string(), number, path.extension().string()));
    if (fs::exists(aside)) continue;
    fs::rename(path, aside);
    fmt::print(stderr, "the old {} is now {}\n", what, aside.string());
    return;
  }
}

/// "2/10", empty for all of the study.
std::string shard_text(const RunSettings& settings) {
  return settings.shards > 0 ? fmt::format("{}/{}", settings.shard, settings.shards) : "";
}

void tell_what_is_there(const sweep::JournalContents& contents) {
  if (contents.damaged > 0) {
    fmt::print(stderr,
               "warning: {} damaged place{} in the journal: those blocks are computed again\n",
               contents.damaged, contents.damaged == 1 ? "" : "s");
  }
  if (contents.done() > 0) {
    fmt::print(stderr, "going on after {} of {} points\n", count_text(contents.done()),
               count_text(contents.header.count));
  }
}

}  // namespace

int run(const StudyOptions& options, const RunSettings& settings) {
  const std::unique_ptr<sweep::Team> team = join_team();
  if (team->rank() > 0) return help_run(*team, options, settings);
  sweep::Lead lead(*team);
  const OpenStudy open = open_study(options);
  const std::string shard = shard_text(settings);
  const std::string path = result_path(open, settings);
  const std::string journal_path = path + ".journal";
  std::error_code different, ignored;
  if (fs::equivalent(path, options.file, different)) {
    throw core::InputError({path, 0}, "is the study itself: give another result file with -o");
  }
  print_warnings(open.study);
  const int threads = options.threads > 0 ? options.threads : core::available_threads();
  sweep::Layout layout = study::layout(open.study);
  layout.attributes = origin(open, options, threads);
  if (!shard.empty()) {
    const sweep::JournalHeader part = journal_header(open, layout, settings, 1);
    layout.attributes.emplace_back("shard", shard);
    layout.attributes.emplace_back("shard_first_point", part.first);
    layout.attributes.emplace_back("shard_points", part.count);
    layout.points_here = (layout.points() + settings.shards - 1) / settings.shards;  // alike in all
  }
  if (team->size() > 1) layout.attributes.emplace_back("ranks", std::int64_t{team->size()});
  std::atomic<bool>& stop = stop_on_signal();  // before there is a file to be left behind
  const sweep::EvaluateBlock evaluate = study::block_evaluator(open.study, &stop);

  std::optional<sweep::JournalContents> there;
  if (settings.fresh) {
    if (!sweep::Journal::is_taken(journal_path)) move_aside(journal_path, "journal");
  } else {
    there = sweep::read_journal(journal_path);
  }
  const bool extends = settings.extend && is_of_another_study(path, open);
  if (extends) check_extends(path, open);
  if (there) {
    check_same(journal_path, there->header, journal_header(open, layout, settings, 1));
  } else if (!settings.fresh && !extends) {
    const auto outcome = finished_result(path, open, shard);
    if (outcome && !(settings.failed && outcome->failed > 0)) {
      return print_outcome(*outcome, options, {});
    }
    if (settings.failed && outcome) check_same_program(path);
    if (settings.failed && !outcome) {
      throw core::InputError({path, 0},
                             "there is no result whose failed points --failed could repeat");
    }
  }
  { const io::AtomicFile target(path); }  // what cannot be written is refused before the work
  lead.meet(team_identity(open));
  const std::string crash_path = crash_record_path(path);
  if (settings.fresh) fs::remove(crash_path, ignored);
  const auto crashes = sweep::read_crashes(crash_path);
  sweep::record_crashes(fs::absolute(crash_path).string());
  const std::int64_t fixed = there              ? there->header.block_size
                             : !crashes.empty() ? sweep::default_block_size(layout)
                                                : 0;
  const Pace pace = chosen_pace(settings, layout, evaluate, threads, fixed);
  limit_memory(settings.memory, pace.threads);
  sweep::Journal journal(journal_path, journal_header(open, layout, settings, pace.block_size),
                         this_process());
  if (settings.failed) reopen_failed(journal, path);
  if (extends) {
    const std::int64_t reused = reuse_points(journal, path, open.study);
    fmt::print(stderr, "{} points are those of the old result\n", count_text(reused));
  }
  fail_crashed_points(journal, crashes);
  tell_what_is_there(journal.contents());
  const double before = journal.contents().seconds;

  ProgressDisplay display(settings.quiet);
  JournalSink sink(journal, settings.disk_patience, stop);
  bool too_many = false;
  const sweep::Progress progress = lead.run(
      evaluate, journal.contents().header, sink, sweep::remainder(journal),
      {.threads = pace.threads, .stop = &stop, .progress = [&](const sweep::Progress& now) {
         display.show(now);
         if (settings.max_failures < 0 || now.failed <= settings.max_failures) return;
         too_many = true;
         stop = true;
       }});
  display.clear();
  if (progress.done() < progress.points) {
    journal.sync();
    fmt::print(stderr, "{} after {} of {} points, which are kept: the same command goes on\n",
               too_many ? fmt::format("stopped by {} failed points", count_text(progress.failed))
                        : "interrupted",
               count_text(progress.done()), count_text(progress.points));
    return kInterrupted;
  }
  const std::unique_ptr<sweep::Sink> writer = io::make_result_writer(path, layout);
  FailureTally tally(*writer);
  sweep::replay(journal, tally);
  if (journal.contents().header.keep_old) move_aside(path, "result");
  const double seconds = before + progress.seconds;
  tally.finish({{"points_ok", progress.ok},
                {"points_failed", progress.failed},
                {"points_skipped", progress.skipped},
                {"points_not_run", layout.points() - progress.points},
                {"wall_time_s", seconds}});
  journal.remove();
  fs::remove(crash_path, ignored);
  return print_outcome({"done", path, progress.ok, progress.failed, progress.skipped, seconds,
                        threads, open.hash, ""},
                       options, tally.counts());
}

}  // namespace millstudy::cli
