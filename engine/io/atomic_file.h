// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace millstudy::io {

/// A file that appears complete or not at all: it is written as path + ".tmp" and renamed to path.
///
/// Destroyed before commit(), it removes the temporary file. A second one on the same path is
/// refused while the first lives.
class AtomicFile {
 public:
  /// @throws core::InputError if the folder does not exist or cannot be written, the path is not
  ///         that of a regular file, or another process writes it
  explicit AtomicFile(std::string path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  const std::string& path() const { return path_; }
  const std::string& temporary_path() const { return temporary_; }

  /// The temporary file, open for reading and writing.
  int descriptor() const { return fd_; }

  /// fsync, rename, fsync of the folder: after it the file survives a power cut.
  /// @throws core::ResourceError
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  int fd_ = -1;
};

}  // namespace millstudy::io
