// SPDX-License-Identifier: MIT
// Of a program that is built with MPI (-DMILLSTUDY_MPI=ON).
#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <list>
#include <mpi.h>

#include "cli/join_team.h"
#include "core/resource_error.h"

namespace millstudy::cli {
namespace {

class MpiTeam : public sweep::Team {
 public:
  MpiTeam() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED) {
      throw core::ResourceError("this MPI library does not allow threads");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiTeam() override {
    for (Sent& one : under_way_) MPI_Wait(&one.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void send(int to, sweep::Note note, std::string bytes) override {
    forget_arrived();
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw core::ResourceError("a block has more than 2 GB: use a smaller --block-size");
    }
    Sent& one = under_way_.emplace_back(Sent{std::move(bytes), MPI_REQUEST_NULL});
    MPI_Isend(one.bytes.data(), static_cast<int>(one.bytes.size()), MPI_BYTE, to,
              static_cast<int>(note), MPI_COMM_WORLD, &one.request);
  }

  std::optional<sweep::Message> receive() override {
    forget_arrived();
    int there = 0;
    MPI_Message handle = MPI_MESSAGE_NULL;
    MPI_Status status;
    MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &handle, &status);
    if (!there) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    sweep::Message message{status.MPI_SOURCE, static_cast<sweep::Note>(status.MPI_TAG), {}};
    message.bytes.resize(static_cast<std::size_t>(size));
    MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
    return message;
  }

  [[noreturn]] void abort(int exit_code) override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();
  }

 private:
  /// A message whose bytes must stay where they are until it has arrived.
  struct Sent {
    std::string bytes;
    MPI_Request request;
  };

  void forget_arrived() {
    under_way_.remove_if([](Sent& one) {
      int arrived = 0;
      MPI_Test(&one.request, &arrived, MPI_STATUS_IGNORE);
      return arrived != 0;
    });
  }

  int rank_ = 0;
  int size_ = 1;
  std::list<Sent> under_way_;
};

/// A program that nobody started with others need not wait for MPI to begin.
bool is_one_of_many() {
  const auto names = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
  return std::any_of(names.begin(), names.end(),
                     [](const char* name) { return std::getenv(name) != nullptr; });
}

}  // namespace

std::unique_ptr<sweep::Team> join_team() {
  if (!is_one_of_many()) return std::make_unique<sweep::Alone>();
  return std::make_unique<MpiTeam>();
}

}  // namespace millstudy::cli
