// SPDX-License-Identifier: MIT
#include "cli/team_run.h"

#include <filesystem>
#include <fmt/core.h>
#include <new>
#include <optional>

#include "cli/pace.h"
#include "cli/provenance.h"
#include "cli/stop_signal.h"
#include "cli/version.h"
#include "core/error.h"
#include "core/parallel_items.h"
#include "study/study.h"
#include "sweep/crash_record.h"
#include "sweep/shared_run.h"

namespace millstudy::cli {
namespace {

std::string all_lines(const core::InputError& error) {
  std::string text;
  for (const core::Fault& fault : error.faults()) {
    text += (text.empty() ? "" : "; ") + to_string(fault);
  }
  return text;
}

}  // namespace

std::string result_path(const OpenStudy& open, const RunSettings& settings) {
  if (!settings.output.empty()) return settings.output;
  if (settings.shards == 0) return open.study.name + ".h5";
  return fmt::format("{}.shard-{}-of-{}.h5", open.study.name, settings.shard, settings.shards);
}

std::string crash_record_path(const std::string& result) {
  return std::filesystem::absolute(result + ".journal.crashes").string();
}

std::string team_identity(const OpenStudy& open) {
  return fmt::format("study {} and {}, instruction set {}", open.hash.substr(0, 16), version_text(),
                     build().isa);
}

int help_run(sweep::Team& team, const StudyOptions& options, const RunSettings& settings) {
  std::atomic<bool>& stop = stop_on_signal();
  std::optional<OpenStudy> open;
  sweep::EvaluateBlock evaluate;
  int threads = options.threads > 0 ? options.threads : core::available_threads();
  try {
    open = open_study(options);
    evaluate = study::block_evaluator(open->study, &stop);
    if (settings.memory > 0) {
      threads = chosen_pace(settings, study::layout(open->study), evaluate, threads, 0).threads;
    }
  } catch (const core::InputError& error) {
    sweep::excuse(team, all_lines(error));
    return kDone;  // the first process tells and has the exit code
  }
  try {
    sweep::record_crashes(crash_record_path(result_path(*open, settings)));
    limit_memory(settings.memory, threads);
    sweep::help(team, team_identity(*open), evaluate, threads, stop);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "rank {}, {}: out of memory: use fewer threads or fewer processes\n",
               team.rank(), this_process());
    team.abort(kInterrupted);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rank {}, {}: {}\n", team.rank(), this_process(), error.what());
    team.abort(kInternalError);
  }
  return kDone;
}

}  // namespace millstudy::cli
