// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace millstudy::sweep {

/// What processes of a team say to each other.
enum class Note : int {
  hello,     ///< to the lead: what I have read of the study, or why I cannot help
  begin,     ///< to a helper: what the journal is of
  want,      ///< to the lead: give me so many blocks
  blocks,    ///< to a helper: compute these
  no_more,   ///< to a helper: there are none left
  halt,      ///< to a helper: the run ends early
  result,    ///< to the lead: a computed block
  bye,       ///< to the lead: all that I had is with you
  dismissed  ///< to a helper: go home
};

struct Message {
  int from = 0;
  Note note{};
  std::string bytes;
};

/// The processes that share a run: rank 0 leads, it owns the journal and hands out blocks; the
/// others help. Messages from one process to another arrive in the order in which they were sent.
///
/// Every process uses its own from one thread at a time.
class Team {
 public:
  virtual ~Team() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Does not wait for the receiver.
  virtual void send(int to, Note note, std::string bytes) = 0;
  /// The next message; nullopt if there is none now.
  virtual std::optional<Message> receive() = 0;
  /// Ends all processes of the team at once.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

/// One process.
class Alone : public Team {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void send(int, Note, std::string) override {}
  std::optional<Message> receive() override { return std::nullopt; }
  [[noreturn]] void abort(int exit_code) override { std::exit(exit_code); }
};

}  // namespace millstudy::sweep
