// SPDX-License-Identifier: MIT
#include "io/traces/source.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"

namespace millstudy::io {

MappedFile::MappedFile(const std::string& path) : source_{path, {}} {
  const auto fail = [&](const std::string& why) -> void {
    throw core::InputError({path, 0}, "cannot be read: " + why);
  };
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) fail(std::strerror(errno));
  struct stat status = {};
  const bool known = fstat(file, &status) == 0;
  if (!known || !S_ISREG(status.st_mode) || status.st_size == 0) {
    close(file);
    fail(S_ISDIR(status.st_mode)    ? "it is a folder"
         : !S_ISREG(status.st_mode) ? "it is not a file"
                                    : "it is empty");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const bytes = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  const int error = errno;
  close(file);
  if (bytes == MAP_FAILED) fail(std::strerror(error));
  madvise(bytes, size, MADV_SEQUENTIAL);
  source_.bytes = {static_cast<const char*>(bytes), size};
}

MappedFile::~MappedFile() {
  munmap(const_cast<char*>(source_.bytes.data()), source_.bytes.size());
}

}  // namespace millstudy::io
