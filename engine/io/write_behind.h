// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace millstudy::io {

/// Writes to a file in a thread of its own: who makes the bytes does not wait for the kernel, which
/// needs as long to take a result as the engine to prepare it.
///
/// Bytes are written in the order they came in. After the first failure nothing more is written.
/// Memory: twice 2 MiB.
class WriteBehind {
 public:
  /// @param fd  open for writing; must outlive this; not closed here
  /// @throws std::system_error if the system gives no thread
  explicit WriteBehind(int fd);
  /// Waits until all is written.
  ~WriteBehind();

  /// Returns once the bytes are copied: at once, unless the file is 2 MiB behind.
  /// @return 0, or the errno of the first failure so far, of this or earlier bytes
  int write(std::uint64_t place, std::string_view bytes);
  /// Until the file has all bytes.
  /// @return as write()
  int wait();

 private:
  struct Piece {
    std::uint64_t place;
    std::size_t size;
  };
  /// Bytes of pieces that follow one another in memory; those that do so in the file are one.
  struct Batch {
    void add(std::uint64_t place, std::string_view more);
    bool empty() const { return pieces.empty(); }
    void clear();

    std::vector<Piece> pieces;
    std::string bytes;
  };

  void write_batches();
  int write_out();

  const int fd_;
  Batch writing_;           ///< the writing thread's alone, as is
  std::size_t unsent_ = 0;  ///< bytes since the disk was last told to begin
  std::mutex mutex_;        ///< guards what follows
  std::condition_variable changed_;
  Batch waiting_;
  bool is_writing_ = false;
  bool closing_ = false;
  int error_ = 0;
  std::thread writer_;
};

}  // namespace millstudy::io
