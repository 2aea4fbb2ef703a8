// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace millstudy::io {

/// A file to read: its name and its bytes.
struct Source {
  std::string path;
  std::string_view bytes;
};

/// A file mapped into memory: nothing is copied, pages come in as they are read.
///
/// A file that another program cuts short while it is read ends this one; so does a failing disk.
class MappedFile {
 public:
  /// @throws core::InputError if there is no such file, or it is empty or not a regular file
  explicit MappedFile(const std::string& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();
  const Source& source() const { return source_; }

 private:
  Source source_;
};

}  // namespace millstudy::io
