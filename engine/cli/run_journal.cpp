// SPDX-License-Identifier: MIT
#include "cli/run_journal.h"

#include <algorithm>
#include <cstring>
#include <fmt/core.h>

#include "cli/version.h"
#include "core/error.h"
#include "io/result_blocks.h"
#include "io/result_reader.h"

namespace millstudy::cli {
namespace {

/// Failed points of a block have no status any more. @return false if there are none
bool forget_failures(sweep::Block& block) {
  bool any = false;
  for (std::int64_t i = 0; i < block.count; ++i) {
    if (block.status[i] != sweep::Status::failed) continue;
    block.status[i] = sweep::Status::not_run;
    block.failures[i].clear();
    any = true;
  }
  return any;
}

}  // namespace

sweep::JournalHeader journal_header(const OpenStudy& open, const sweep::Layout& layout,
                                    const RunSettings& settings, std::int64_t block_size) {
  sweep::JournalHeader header;
  header.study_hash = open.hash;
  header.isa = build().isa;
  header.build = version_text();
  header.study = open.text;
  header.points = header.count = layout.points();
  if (settings.shards > 0) {
    // Whole blocks of a size that does not depend on how fast this machine is.
    const std::int64_t size = sweep::default_block_size(layout);
    const std::int64_t blocks = (header.points + size - 1) / size;
    header.first = blocks * (settings.shard - 1) / settings.shards * size;
    header.count =
        std::min(header.points, blocks * settings.shard / settings.shards * size) - header.first;
  }
  header.block_size = block_size;
  header.columns = static_cast<std::int64_t>(layout.columns.size());
  header.traces = layout.traces;
  header.keep_old = settings.fresh || settings.extend;
  return header;
}

void check_same(const std::string& path, const sweep::JournalHeader& there,
                const sweep::JournalHeader& wanted) {
  const auto refuse = [&](const std::string& why) { throw core::InputError({path, 0}, why); };
  if (there.study_hash != wanted.study_hash) {
    refuse(
        "holds the unfinished result of another study; use --fresh to begin this one (the journal "
        "is moved aside), or -o for another file");
  }
  if (there.isa != wanted.isa) {
    refuse(
        fmt::format("was begun with the instruction set {}, this program has {}: digits would "
                    "differ; finish it there, or use --fresh",
                    there.isa, wanted.isa));
  }
  if (there.build != wanted.build) {
    refuse(
        fmt::format("was begun by {}, this program is {}: finish it with that one, or use "
                    "--fresh",
                    there.build, wanted.build));
  }
  if (there.points != wanted.points || there.columns != wanted.columns ||
      there.traces != wanted.traces || there.first != wanted.first || there.count != wanted.count) {
    refuse("was begun for other points of the study; use --fresh, or -o for another file");
  }
}

void check_same_program(const std::string& path) {
  const io::ResultSummary there = io::read_result_summary(path).value_or(io::ResultSummary{});
  const Build made = build();
  if (there.text("isa") == made.isa && there.text("git_revision") == made.git_revision &&
      there.text("millstudy_version") == made.version) {
    return;
  }
  throw core::InputError({path, 0},
                         "was computed by another program or instruction set: points computed now "
                         "would differ in their last digits; use --fresh");
}

void reopen_failed(sweep::Journal& journal, const std::string& result) {
  const sweep::JournalHeader& header = journal.contents().header;
  if (journal.contents().entries.empty()) {
    const io::ResultBlocks blocks(result);
    for (std::int64_t i = 0; i < header.blocks(); ++i) {
      sweep::Block block = blocks.read(header.first_of(i), header.count_of(i));
      forget_failures(block);
      if (!block.values.empty()) journal.append(block, {});
    }
    return;
  }
  for (std::int64_t i = 0; i < header.blocks(); ++i) {
    if (journal.contents().entry(i).failed == 0) continue;
    sweep::Block block = journal.read(i);
    if (forget_failures(block)) journal.append(block, {});
  }
}

void fail_crashed_points(sweep::Journal& journal,
                         const std::map<std::int64_t, sweep::Crashes>& crashes) {
  const sweep::JournalHeader& header = journal.contents().header;
  for (const auto& [point, crash] : crashes) {
    const std::int64_t within = point - header.first;
    if (crash.times < 2 || within < 0 || within >= header.count) continue;
    sweep::Block block = journal.read(within / header.block_size);
    const std::int64_t i = point - block.first;
    if (block.status[i] != sweep::Status::not_run) continue;
    block.status[i] = sweep::Status::failed;
    block.failures[i] = fmt::format("crashed the program twice ({})", strsignal(crash.signal));
    journal.append(block, {});
    fmt::print(stderr, "warning: point {} {}: it is recorded as failed\n", point,
               block.failures[i]);
  }
}

}  // namespace millstudy::cli
