// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <string>

#include "sweep/journal_format.h"
#include "sweep/runner.h"
#include "sweep/team.h"

/// A run that several processes share.
///
///     helper                 lead
///     hello            ->
///                      <-    begin
///     want             ->
///                      <-    blocks, no_more, or at any time halt
///     result ... bye   ->
///                      <-    dismissed, also instead of begin
namespace millstudy::sweep {

/// Rank 0 of a team. When it goes the others go home, whatever it was that ended it.
class Lead {
 public:
  explicit Lead(Team& team) : team_(team) {}
  ~Lead();
  Lead(const Lead&) = delete;
  Lead& operator=(const Lead&) = delete;

  /// Waits until everybody has read the study.
  /// @param identity  of the study and the program; must be everybody's
  /// @throws core::InputError with a line for each who read something else, or could not
  void meet(const std::string& identity);

  /// run_blocks() by all of the team, this process among them.
  /// @param header  of the journal that the blocks are of
  Progress run(const EvaluateBlock& evaluate, const JournalHeader& header, Sink& sink,
               const Remainder& remainder, const RunOptions& options);

 private:
  void tell_all(Note note, const std::string& bytes);
  Message next_hello();

  Team& team_;
  bool met_ = false;
};

/// What the other ranks do: computes blocks for the lead until it has no more.
/// @param stop  set from outside to end early: what is in flight is still handed in
void help(Team& team, const std::string& identity, const EvaluateBlock& evaluate, int threads,
          std::atomic<bool>& stop);

/// Instead of help(): tells the lead why this process cannot, and waits to be sent home.
void excuse(Team& team, const std::string& why);

}  // namespace millstudy::sweep
